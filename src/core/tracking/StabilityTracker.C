// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/tracking/StabilityTracker.H"

#include "core/Busy.H"
#include "core/Errors.H"
#include "core/analysis/ThinSheets.H"
#include "core/parametrization/Flattening.H"
#include "core/reconstruction/CellPlacement.H"
#include "core/reconstruction/InterfaceMotion.H"
#include "core/reconstruction/NoiseFloor.H"

#include <cmath>
#include <sstream>
#include <utility>

namespace Foam::stability
{

namespace
{

void add(IntegrationCounts& sum, const IntegrationCounts& part)
{
    sum.nSteps += part.nSteps;
    sum.nRejected += part.nRejected;
    sum.nLeft += part.nLeft;
    sum.nStuck += part.nStuck;
    sum.nLost += part.nLost;
    sum.nElsewhere += part.nElsewhere;
}

} // namespace

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
    changes_ = {
        {-VGREAT, options_.reconstruction, options_.matching, options_.transfer}};
    for (const ReconstructionFrom& later : options_.later)
    {
        if (!(later.from > changes_.back().from))
        {
            throw BadInput("The times from which on other reconstructions apply must "
                           "ascend.");
        }
        changes_.push_back(later);
    }
    for (ReconstructionFrom& change : changes_)
    {
        change.reconstruction.nThreads = options_.nThreads;
        change.matching.nThreads = options_.nThreads;
        change.transfer.nThreads = options_.nThreads;
        reconstructions_.push_back(Reconstruction::New(change.reconstruction));
    }
}

// Of the changes the last that has begun.
std::size_t StabilityTracker::present() const
{
    std::size_t i = changes_.size() - 1;
    while (i > 0 && !hasBegun(changes_[i].from, latest_->time))
    {
        --i;
    }
    return i;
}

void StabilityTracker::enter(Phase phase) const
{
    if (options_.entering)
    {
        options_.entering(phase);
    }
}

scalar StabilityTracker::time() const
{
    return latest_->time;
}

void StabilityTracker::start(std::shared_ptr<const FlowSnapshot> snapshot)
{
    snapshot->check();
    latest_ = std::move(snapshot);
    latestVelocity_ =
        std::make_shared<const PointVelocity>(latest_, options_.wallVelocity);
    lastClassified_ = latest_->time;
}

void StabilityTracker::together(const std::function<void()>& work) const
{
    stability::together(exchange_, work);
}

IntegrationCounts StabilityTracker::advanceAll(
    DynamicList<Pathline>& paths, const Velocity& velocity
) const
{
    return stability::advance(paths, velocity, options_.integration);
}

IntegrationCounts StabilityTracker::sumOf(const IntegrationCounts& here) const
{
    return here;
}

void StabilityTracker::advance(std::shared_ptr<const FlowSnapshot> snapshot)
{
    snapshot->check();
    if (!(snapshot->time > latest_->time))
    {
        std::ostringstream message;
        message << "A snapshot at " << snapshot->time << " s cannot follow one at "
                << latest_->time << " s.";
        throw BadInput(message.str());
    }
    std::shared_ptr<const PointVelocity> velocity;
    together(
        [&] {
            velocity =
                std::make_shared<const PointVelocity>(snapshot, options_.wallVelocity);
        }
    );
    const VelocityInterval interval(latestVelocity_, velocity);
    {
        const Busy watch(timings_.advection);
        together([&] { enter(Phase::advection); });
        add(surfaceCounts_, advanceAll(pathlines_, interval));
    }
    {
        const Busy watch(timings_.particles);
        together([&] { enter(Phase::particles); });
        add(particleCounts_, advanceAll(particlePaths_, interval));
    }
    latest_ = std::move(snapshot);
    latestVelocity_ = velocity;
}

void StabilityTracker::placeTimeSurface()
{
    const CellComplex& complex = *site_->complex;
    forAll(pathlines_, pointi)
    {
        const Pathline& path = pathlines_[pointi];
        timeSurface_.points[pointi] = path.x;
        const label celli = path.hint.cell < 0 ? -1 : complex.localCell(path.hint.cell);
        if (celli >= 0)
        {
            timeSurface_.cells[pointi] = celli;
            timeSurface_.cellSizes[pointi] = complex.cellSizes()[celli];
        }
    }
}

scalar StabilityTracker::displacement()
{
    const CellComplex& complex = *latest_->complex;
    List<scalar> sums(2, scalar(0));
    for (const Pathline& path : pathlines_)
    {
        if (path.hint.cell >= 0)
        {
            const scalar h = complex.cellSizes()[path.hint.cell];
            sums[0] += path.weight * magSqr(path.x - path.start) / sqr(h);
            sums[1] += path.weight;
        }
    }
    return sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : 0;
}

StabilityTracker::SmallScales StabilityTracker::smallScales(const InterfaceMesh& mesh)
{
    const Busy watch(timings_.matching);
    const labelList components(pointComponents(mesh));
    SmallScales scales;
    scales.thin = thinPoints(mesh, options_.nThreads);
    scales.droplets = subGridDroplets(mesh, components, *site_);
    scales.subGrid = subGridPoints(components, scales.droplets);
    return scales;
}

void StabilityTracker::seedPathlines(
    const InterfaceMesh& mesh, const SmallScales& scales
)
{
    timeSurface_ = mesh;
    seedScales_ = scales;
    seeds_ = mesh.points;
    pathlines_.clear();
    const scalarField areas(mesh.pointAreas());
    forAll(mesh.points, pointi)
    {
        Pathline path;
        path.id = pointi;
        path.x = path.start = mesh.points[pointi];
        path.weight = areas[pointi];
        path.time = latest_->time;
        path.hint.cell = site_->complex->globalCell(mesh.cells[pointi]);
        pathlines_.append(path);
    }
}

// Remeshing moves points into cells next to those of the interface.
void StabilityTracker::findCells(InterfaceMesh& surface) const
{
    const CellComplex& complex = *site_->complex;
    forAll(surface.points, pointi)
    {
        label& celli = surface.cells[pointi];
        if (!liesWithin(complex, celli, surface.points[pointi]))
        {
            celli = complex.findCell(surface.points[pointi]);
            surface.cellSizes[pointi] = complex.cellSizes()[celli];
        }
    }
}

// Step 1 of the method (paper 4.2): the first interface there is gets p, and T starts
// from its flattened copy.
void StabilityTracker::startSurface(const InterfaceMesh& mesh)
{
    {
        enter(Phase::parametrization);
        const Busy watch(timings_.parametrization);
        result_.parametrization = parametrize(mesh, options_.parametrization);
    }
    InterfaceMesh& surface = result_.parametrization->surface;
    findCells(surface);
    chart_ = StartChart(surface);
    seedPathlines(surface, smallScales(surface));
    parametrized_ = true;
}

ReconstructionResult StabilityTracker::extractWhole(const Reconstruction& reconstruction
)
{
    ReconstructionResult local;
    together([&] { local = reconstruction.extract(*latest_); });
    local.mesh.triangleCells.clear();
    return local;
}

ReconstructionResult StabilityTracker::extract()
{
    const Busy watch(timings_.reconstruction);
    together([&] { enter(Phase::reconstruction); });
    ReconstructionResult result(extractWhole(*reconstructions_[present()]));
    result_.statistics.noiseFloor = noiseFloor(
        result, changes_[present()].reconstruction,
        [&](const ReconstructionOptions& other)
        { return extractWhole(*Reconstruction::New(other)).mesh; }
    );
    return result;
}

// All that there is of T, of the particles, and of the cells around the surfaces, to
// the rank that has the whole of M.
void StabilityTracker::bringTogether(InterfaceMesh& extracted)
{
    particles_.setPaths(particlePaths_);
    site_ = latest_;
    for (label& celli : extracted.cells)
    {
        celli = site_->complex->localCell(celli);
    }
}

// And back to where they go on.
void StabilityTracker::sendOut()
{
    particlePaths_ = particles_.paths();
    site_.reset();
}

// What noise leaves of the classes.
void StabilityTracker::rateClasses()
{
    for (ClassifiedSurface* surface : {&result_.interface, &result_.timeSurface})
    {
        surface->confidence =
            confidences(*surface, result_.epsilon, result_.statistics.noiseFloor);
    }
}

// Steps 4 and 5 of the method: both surfaces against each other, p to the new one.
void StabilityTracker::compare(const InterfaceMesh& extracted)
{
    const ReconstructionFrom& now = changes_[present()];
    const MatchTarget target(timeSurface_, now.matching);
    InterfaceMesh mesh(extracted);
    List<Match> onInterface;
    List<Match> onTimeSurface;
    {
        enter(Phase::matching);
        const Busy watch(timings_.matching);
        const MatchTarget interfaceTarget(mesh, now.matching);
        onTimeSurface = matchPoints(timeSurface_, interfaceTarget, now.matching);
        onInterface = matchPoints(mesh, target, now.matching);
    }
    {
        enter(Phase::transfer);
        const Busy watch(timings_.transfer);
        result_.transfer = transfer(mesh, onInterface, target, now.transfer, chart_);
    }
    const CellComplex& complex = *site_->complex;
    settleInCells(mesh, complex, extracted.points.size()); // what seams have added
    const scalar interval = latest_->time - lastClassified_;
    result_.interface =
        describe(mesh, onInterface, Stability::attached, complex, interval);
    result_.timeSurface =
        describe(timeSurface_, onTimeSurface, Stability::detached, complex, interval);
    SmallScales scales(smallScales(mesh));
    result_.interface.thin = std::move(scales.thin);
    result_.interface.subGrid = std::move(scales.subGrid);
    result_.droplets = std::move(scales.droplets);
    result_.timeSurface.thin = seedScales_.thin;
    result_.timeSurface.subGrid = seedScales_.subGrid;
    forAll(pathlines_, pointi)
    {
        if (pathlines_[pointi].state == PathlineState::left)
        {
            result_.timeSurface.stability[pointi] = Stability::left;
        }
    }
}

void StabilityTracker::seedParticles()
{
    const List<Stability>& stability = result_.timeSurface.stability;
    List<bool> detached(stability.size());
    forAll(detached, pointi)
    {
        detached[pointi] = stability[pointi] == Stability::detached;
    }
    particles_.seed(
        timeSurface_, detached, result_.timeSurface.components, *site_->complex,
        latest_->time
    );
    result_.nSkippedParticles = particles_.nSkipped();
}

void StabilityTracker::takeStock(const ReconstructionResult& extracted)
{
    enter(Phase::statistics);
    const Busy watch(timings_.statistics);
    Statistics& statistics = result_.statistics;
    statistics.time = latest_->time;
    statistics.interval = latest_->time - lastClassified_;
    statistics.volumeError = extracted.volumeError();
    result_.nFailedCells = extracted.nFailed;
    result_.volumeFit = extracted.volumeFit;
    statistics.nParticles = particles_.size();
    statistics.nMerged = result_.transfer.nMerged;
    statistics.nSplit = result_.transfer.nSplit;
    survey(statistics, result_.interface, result_.timeSurface, result_.epsilon);
    surveyDisplacement(statistics, timeSurface_, seeds_);
}

// Step 6: the interface is the seed of the next time surface.
void StabilityTracker::handOn(bool begins)
{
    if (!begins)
    {
        const ClassifiedSurface& M = result_.interface;
        seedPathlines(M.mesh, {M.thin, M.subGrid, {}});
    }
    else if (nClassified_ > 0)
    {
        // The first interface appeared just now: all of it is attached, and T starts
        // from its flattened copy, which is written in T's place.
        startSurface(result_.interface.mesh);
        List<Match> atHome(timeSurface_.points.size());
        for (Match& match : atHome)
        {
            match.stable = true;
            match.nPreimages = 1;
            match.nearest.distance = 0;
        }
        result_.timeSurface =
            describe(timeSurface_, atHome, Stability::stable, *site_->complex, 0);
        result_.timeSurface.thin = seedScales_.thin;
        result_.timeSurface.subGrid = seedScales_.subGrid;
    }
}

// What one rank does alone, with the whole surfaces.
void StabilityTracker::classifyWhole(ReconstructionResult& extracted)
{
    const bool begins = !parametrized_ && !extracted.mesh.empty();
    if (begins && nClassified_ == 0)
    {
        startSurface(extracted.mesh);
    }
    placeTimeSurface();
    compare(extracted.mesh);
    seedParticles();
    takeStock(extracted);
    handOn(begins);
    rateClasses();
}

const Classification& StabilityTracker::classify()
{
    result_ = Classification();
    result_.index = nClassified_;
    result_.epsilon = changes_[present()].matching.epsilon;
    result_.timeSurfaceCounts = sumOf(std::exchange(surfaceCounts_, {}));
    result_.particleCounts = sumOf(std::exchange(particleCounts_, {}));

    ReconstructionResult extracted(extract());
    bringTogether(extracted.mesh);
    together([&] { classifyWhole(extracted); });
    sendOut();

    lastClassified_ = latest_->time;
    ++nClassified_;
    return result_;
}

} // namespace Foam::stability
