// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/StabilityTracker.H"

#include "core/base/ScopedTimer.H"
#include "core/base/Errors.H"
#include "core/parametrization/FlatteningMethods.H"
#include "core/ranks/ExactSum.H"
#include "core/reconstruction/NoiseFloor.H"
#include "core/surface/Ribbon.H"
#include "core/surface/pieces/TornEdges.H"

#include <algorithm>
#include <sstream>
#include <utility>

namespace Foam::stability
{

StabilityTracker::StabilityTracker(
    const TrackerOptions& options, const Exchange& exchange
)
    : options_(options), exchange_(exchange), particles_(options.maxParticles)
{
    const auto prepare = [&]
    {
        makeReconstructions();
        Flattening::New(options.parametrization.flattening); // throws for unknown names
    };
    runOnAllRanks(exchange, prepare);
    options_.integration.nThreads = options.nThreads;
}

StabilityTracker::~StabilityTracker() = default;

void StabilityTracker::makeReconstructions()
{
    settings_ = {
        {-VGREAT, options_.reconstruction, options_.matching, options_.transfer}};
    for (const ReconstructionFrom& later : options_.later)
    {
        if (!(later.from > settings_.back().from))
        {
            throw BadInput("The times from which on other reconstructions apply must "
                           "ascend.");
        }
        settings_.push_back(later);
    }
    for (ReconstructionFrom& change : settings_)
    {
        change.reconstruction.nThreads = options_.nThreads;
        change.matching.nThreads = options_.nThreads;
        change.transfer.nThreads = options_.nThreads;
        reconstructions_.push_back(Reconstruction::New(change.reconstruction));
    }
}

std::size_t StabilityTracker::activeSettings() const
{
    std::size_t i = settings_.size() - 1;
    while (i > 0 && !hasBegun(settings_[i].from, latest_->time))
    {
        --i;
    }
    return i;
}

void StabilityTracker::enter(Phase phase) const
{
    if (options_.entering)
    {
        runOnAllRanks(exchange_, [&] { options_.entering(phase); });
    }
}

Comparison::Setting StabilityTracker::setting() const
{
    const ReconstructionFrom& change = settings_[activeSettings()];
    return {
        latest_,
        change.matching,
        change.transfer,
        latest_->time - lastClassified_,
        hasOpenings_ ? &history_ : nullptr,
        options_.integration,
        Run{exchange_, options_.nThreads}};
}

scalar StabilityTracker::time() const
{
    return latest_->time;
}

// Checks the snapshot first.
std::shared_ptr<const PointVelocity>
StabilityTracker::velocityOf(const std::shared_ptr<const FlowSnapshot>& snapshot) const
{
    std::shared_ptr<const PointVelocity> velocity;
    runOnAllRanks(
        exchange_,
        [&]
        {
            snapshot->check();
            velocity =
                std::make_shared<const PointVelocity>(snapshot, options_.wallVelocity);
        }
    );
    return velocity;
}

void StabilityTracker::start(std::shared_ptr<const FlowSnapshot> snapshot)
{
    latestVelocity_ = velocityOf(snapshot);
    latest_ = std::move(snapshot);
    lastClassified_ = latest_->time;
    const List<BoundaryKind>& kinds = complex().kinds();
    const bool opens =
        std::find(kinds.begin(), kinds.end(), BoundaryKind::open) != kinds.end();
    hasOpenings_ = exchange_.total(opens) > 0;
    history_.begin(latestVelocity_);
}

void StabilityTracker::advance(std::shared_ptr<const FlowSnapshot> snapshot)
{
    if (!(snapshot->time > latest_->time))
    {
        std::ostringstream message;
        message << "A snapshot at " << snapshot->time << " s cannot follow one at "
                << latest_->time << " s.";
        throw BadInput(message.str());
    }
    const auto velocity = velocityOf(snapshot);
    const VelocityInterval interval(latestVelocity_, velocity);
    {
        const ScopedTimer watch(timings_.advection);
        enter(Phase::advection);
        if (nClassified_ == 1 && latest_->time == lastClassified_)
        {
            impulsiveStart_.consider(
                timeSurface_, *latestVelocity_, *velocity, options_.wallVelocity,
                exchange_
            );
        }
        surfaceCounts_ +=
            timeSurface_.advance(interval, options_.integration, complex(), exchange_);
        if (impulsiveStart_.isOpen())
        {
            impulsiveStart_.advance(
                latestVelocity_, velocity, options_.integration, complex(), exchange_
            );
        }
    }
    {
        const ScopedTimer watch(timings_.particles);
        enter(Phase::particles);
        particleCounts_ +=
            particles_.advance(interval, options_.integration, complex(), exchange_);
    }
    latest_ = std::move(snapshot);
    latestVelocity_ = velocity;
    if (hasOpenings_)
    {
        history_.add(velocity);
    }
}

scalar StabilityTracker::displacement()
{
    return timeSurface_.displacement(complex(), exchange_);
}

ExtractedSurface StabilityTracker::extract()
{
    enter(Phase::reconstruction);
    const ScopedTimer watch(timings_.reconstruction);
    const std::size_t i = activeSettings();
    return extractSurface(
        *reconstructions_[i], settings_[i].reconstruction, latest_,
        Run{exchange_, options_.nThreads}
    );
}

// Step 4 of the method, and the particles of step 5.
void StabilityTracker::compare(const ExtractedSurface& extracted)
{
    enter(Phase::matching);
    std::optional<ScopedTimer> watch(timings_.matching);
    timeSurface_.collectPoints(latest_->time, complex(), exchange_);
    // At the start T is M, but for the remeshing.
    const bool starts = nClassified_ == 0 && parametrized_;
    Comparison comparison(
        starts ? settingOfCopy() : setting(), extracted.piece, timeSurface_
    );
    const ReconstructionMethod& method =
        reconstructionMethod(settings_[activeSettings()].reconstruction.method);
    if (method.sharesPoints && !method.readsFiles)
    {
        result_.nTornEdges =
            tornEdges(comparison.interface(), complex().whole().section, exchange_);
    }
    comparison.match();
    watch.emplace(timings_.reconstruction);
    estimateNoiseFloor(extracted, comparison.interface());

    enter(Phase::transfer);
    watch.emplace(timings_.transfer);
    result_.transfer = comparison.carryOver(chart_);
    result_.interface = comparison.describeInterface(result_.droplets);
    const ClassifiedSurface timeSurface(comparison.describeTimeSurface());
    result_.timeSurface = toOwned(timeSurface, comparison.timeSurface(), timeSurface_);
    watch.emplace(timings_.particles);
    particles_.seed(
        timeSurface, comparison.timeSurface(), complex(), latest_->time, exchange_
    );
    result_.nSkippedParticles = particles_.nSkipped();
}

void StabilityTracker::estimateNoiseFloor(
    const ExtractedSurface& fresh, const SurfaceHalo& halo
)
{
    result_.statistics.noiseFloor = noiseFloor(
        fresh.piece.mesh, fresh.spread, halo.toOwned(halo.primaryPoints()),
        settings_[activeSettings()].reconstruction,
        [&](const ReconstructionOptions& other)
        { return Reconstruction::New(other)->extract(*latest_).mesh; },
        Run{exchange_, options_.nThreads}
    );
}

void StabilityTracker::computeStatistics(const ExtractedSurface& extracted)
{
    enter(Phase::statistics);
    const ScopedTimer watch(timings_.statistics);
    Statistics& statistics = result_.statistics;
    statistics.time = latest_->time;
    statistics.interval = latest_->time - lastClassified_;
    statistics.volumeError = extracted.result.volumeError();
    result_.nFailedCells = extracted.result.nFailed;
    result_.volumeFit = extracted.result.volumeFit;
    statistics.nParticles = particles_.nSeeded();
    statistics.nMerged = result_.transfer.nMerged;
    statistics.nSplit = result_.transfer.nSplit;
    addSurfaceStatistics(
        statistics, result_.interface, result_.timeSurface, result_.epsilon, exchange_,
        complex().whole().section
    );
    addMotion(
        statistics, result_.timeSurface, timeSurface_.piece().startPositions, exchange_,
        complex().whole().section
    );
}

// Steps 6 and 2: the next time surface starts from the interface.
void StabilityTracker::reseedTimeSurface(const ClassifiedSurface& interface)
{
    const ScopedTimer watch(timings_.advection);
    SurfacePiece piece;
    static_cast<SurfaceOrder&>(piece) = interface.order;
    piece.mesh = interface.mesh;
    PointMarks marks(interface);
    if (hasOpenings_)
    {
        // From now on what entered counts.
        const SurfaceHalo halo(surroundings(piece, setting()));
        marks.areas =
            halo.toOwned(pointAreasInMesh(halo.mesh(), complex().whole().section));
    }
    timeSurface_.seed(piece, marks, latest_->time, complex(), exchange_);
}

const Classification& StabilityTracker::classify()
{
    result_ = Classification();
    result_.index = nClassified_;
    result_.epsilon = settings_[activeSettings()].matching.epsilon;
    result_.timeSurfaceCounts = total(std::exchange(surfaceCounts_, {}), exchange_);
    result_.particleCounts = total(std::exchange(particleCounts_, {}), exchange_);

    const ExtractedSurface extracted(extract());
    const bool begins =
        !parametrized_ && exchange_.total(extracted.piece.mesh.triangles.size()) > 0;
    if (begins && nClassified_ == 0)
    {
        startSurface(extracted.piece);
    }
    else if (impulsiveStart_.isOpen())
    {
        result_.impulsiveStart =
            impulsiveStart_.decide(extracted.piece, timeSurface_, history_, setting());
    }
    compare(extracted);
    computeStatistics(extracted);
    reseedTimeSurface(
        begins && nClassified_ > 0 ? appearedInterface(extracted.piece)
                                   : result_.interface
    );
    for (ClassifiedSurface* surface : {&result_.interface, &result_.timeSurface})
    {
        surface->confidence =
            confidences(*surface, result_.epsilon, result_.statistics.noiseFloor);
    }
    result_.droplets = gatheredDroplets(result_.droplets, exchange_);

    lastClassified_ = latest_->time;
    history_.begin(latestVelocity_);
    ++nClassified_;
    return result_;
}

} // namespace Foam::stability
