// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/StabilityTracker.H"

#include "core/base/ScopedTimer.H"
#include "core/base/Errors.H"
#include "core/parametrization/FlatteningMethods.H"
#include "core/ranks/ExactSum.H"
#include "core/reconstruction/NoiseFloor.H"
#include "core/surface/pieces/SharedPoints.H"
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
    makeReconstructions();
    Flattening::New(options.parametrization.flattening); // throws for unknown names
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
        latest_, change.matching, change.transfer, latest_->time - lastClassified_,
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
}

IntegrationCounts StabilityTracker::sumOf(const IntegrationCounts& here) const
{
    IntegrationCounts all;
    all.nSteps = exchange_.total(here.nSteps);
    all.nRejected = exchange_.total(here.nRejected);
    all.nLeft = exchange_.total(here.nLeft);
    all.nStuck = exchange_.total(here.nStuck);
    all.nLost = exchange_.total(here.nLost);
    return all;
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
        surfaceCounts_ +=
            timeSurface_.advance(interval, options_.integration, complex(), exchange_);
    }
    {
        const ScopedTimer watch(timings_.particles);
        enter(Phase::particles);
        particleCounts_ +=
            particles_.advance(interval, options_.integration, complex(), exchange_);
    }
    latest_ = std::move(snapshot);
    latestVelocity_ = velocity;
}

scalar StabilityTracker::displacement()
{
    return timeSurface_.displacement(complex(), exchange_);
}

StabilityTracker::Extracted StabilityTracker::extract()
{
    enter(Phase::reconstruction);
    const ScopedTimer watch(timings_.reconstruction);
    Extracted extracted;
    List<NamedPoint> shared;
    runOnAllRanks(
        exchange_,
        [&]
        {
            ReconstructionResult& result = extracted.result;
            result = reconstructions_[activeSettings()]->extract(*latest_);
            extracted.piece.sharesPoints =
                reconstructionMethod(settings_[activeSettings()].reconstruction.method)
                    .sharesPoints;
            const labelList kept(
                stability::keepOwn(extracted.piece, result.mesh, complex())
            );
            extracted.spread = result.sharpening
                                   ? scalarField(result.sharpening->spread, kept)
                                   : scalarField(kept.size(), 0);
            shared = sharedPoints(result.mesh, kept, complex());
            result.mesh = InterfaceMesh();
        }
    );
    agreeOnPoints(extracted.piece, extracted.spread, shared, exchange_);
    List<ExactSum> volumes(2);
    volumes[0].add(extracted.result.volume);
    volumes[1].add(extracted.result.alphaVolume);
    sum(volumes, exchange_);
    extracted.result.volume = volumes[0].value();
    extracted.result.alphaVolume = volumes[1].value();
    extracted.result.nFailed = exchange_.total(extracted.result.nFailed);
    return extracted;
}

// Step 1 of the method (paper 4.2): the first interface there is gets p, and T starts
// from its flattened copy.
void StabilityTracker::startSurface(const SurfacePiece& interface)
{
    enter(Phase::parametrization);
    const ScopedTimer watch(timings_.parametrization);
    const Comparison::Setting setting(this->setting());
    {
        const Components components(
            surroundings(interface, setting), setting.referencePoint(), exchange_
        );
        const List<bool> all(interface.mesh.triangles.size(), true);
        result_.parametrization = parametrize(
            wholeComponents(interface, components, all, exchange_).piece,
            options_.parametrization, exchange_
        );
    }
    SurfacePiece& surface = result_.parametrization->surface;
    surface = join({surface}).piece; // points in the order of triangles
    PointMarks marks;
    marks.areas = surface.mesh.pointAreas();
    marks.isPrimary = List<bool>(surface.mesh.points.size(), true);
    timeSurface_.seedRemeshed(surface, marks, latest_->time, complex(), exchange_);
    surface = timeSurface_.piece();
    chart_ = DistributedChart(surface, complex().whole(), exchange_);

    const SurfaceHalo halo(surroundings(surface, setting));
    const SmallScales scales(smallScales(
        surface, halo, Components(halo, setting.referencePoint(), exchange_), latest_,
        setting.run
    ));
    timeSurface_.setSmallScales(
        halo.toOwned(scales.thin), halo.toOwned(scales.subGrid)
    );
    parametrized_ = true;
}

// Step 4 of the method, and the particles of step 5.
void StabilityTracker::compare(const Extracted& extracted)
{
    enter(Phase::matching);
    std::optional<ScopedTimer> watch(timings_.matching);
    timeSurface_.collectPoints(complex(), exchange_);
    Comparison comparison(setting(), extracted.piece, timeSurface_);
    const ReconstructionMethod& method =
        reconstructionMethod(settings_[activeSettings()].reconstruction.method);
    if (method.sharesPoints && !method.readsFiles)
    {
        result_.nTornEdges = tornEdges(comparison.interface(), exchange_);
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
    const Extracted& fresh, const SurfaceHalo& halo
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

void StabilityTracker::computeStatistics(const Extracted& extracted)
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
        statistics, result_.interface, result_.timeSurface, result_.epsilon, exchange_
    );
    addDisplacement(
        statistics, result_.timeSurface, timeSurface_.piece().startPositions, exchange_
    );
}

// Steps 6 and 2: the next time surface starts from the interface.
void StabilityTracker::reseedTimeSurface(bool begins)
{
    const ClassifiedSurface& interface = result_.interface;
    SurfacePiece piece;
    static_cast<SurfaceOrder&>(piece) = interface.order;
    piece.mesh = interface.mesh;
    if (!begins)
    {
        const ScopedTimer watch(timings_.advection);
        timeSurface_.seed(piece, interface, latest_->time, complex(), exchange_);
    }
    else if (nClassified_ > 0)
    {
        // The first interface appeared just now: all of it is attached, and T starts
        // from its flattened copy, which is written in T's place.
        startSurface(piece);
        const SurfaceHalo halo(surroundings(timeSurface_.piece(), setting()));
        List<Match> atHome(halo.mesh().points.size());
        for (Match& match : atHome)
        {
            match.stable = true;
            match.nPreimages = 1;
            match.nearest.distance = 0;
        }
        result_.timeSurface = toOwned(
            describe(timeSurface_, halo, atHome, setting()), halo, timeSurface_
        );
    }
}

const Classification& StabilityTracker::classify()
{
    result_ = Classification();
    result_.index = nClassified_;
    result_.epsilon = settings_[activeSettings()].matching.epsilon;
    result_.timeSurfaceCounts = sumOf(std::exchange(surfaceCounts_, {}));
    result_.particleCounts = sumOf(std::exchange(particleCounts_, {}));

    Extracted extracted(extract());
    const bool begins =
        !parametrized_ && exchange_.total(extracted.piece.mesh.triangles.size()) > 0;
    if (begins && nClassified_ == 0)
    {
        startSurface(extracted.piece);
    }
    compare(extracted);
    computeStatistics(extracted);
    reseedTimeSurface(begins);
    for (ClassifiedSurface* surface : {&result_.interface, &result_.timeSurface})
    {
        surface->confidence =
            confidences(*surface, result_.epsilon, result_.statistics.noiseFloor);
    }
    result_.droplets = gatheredDroplets(result_.droplets, exchange_);

    lastClassified_ = latest_->time;
    ++nClassified_;
    return result_;
}

} // namespace Foam::stability
