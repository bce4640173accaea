// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/tracking/StabilityTracker.H"

#include "core/Errors.H"
#include "core/analysis/ThinSheets.H"
#include "core/parametrization/Flattening.H"
#include "core/reconstruction/InterfaceMotion.H"
#include "core/reconstruction/NoiseFloor.H"

#include <chrono>
#include <sstream>
#include <utility>

namespace Foam::stability
{

namespace
{

// Adds the seconds of its life to a counter.
class Stopwatch
{
public:
    explicit Stopwatch(scalar& seconds) : seconds_(seconds) {}
    ~Stopwatch()
    {
        const std::chrono::duration<scalar> life = Clock::now() - start_;
        seconds_ += life.count();
    }

private:
    using Clock = std::chrono::steady_clock;
    scalar& seconds_;
    Clock::time_point start_ = Clock::now();
};

void add(IntegrationCounts& sum, const IntegrationCounts& part)
{
    sum.nSteps += part.nSteps;
    sum.nRejected += part.nRejected;
    sum.nLeft += part.nLeft;
    sum.nStuck += part.nStuck;
    sum.nLost += part.nLost;
    sum.nElsewhere += part.nElsewhere;
}

scalar largestCell(const InterfaceMesh& mesh)
{
    return mesh.cellSizes.empty() ? 0 : max(mesh.cellSizes);
}

} // namespace

StabilityTracker::StabilityTracker(
    const TrackerOptions& options, const Exchange& exchange
)
    : options_(options), exchange_(exchange), particles_(options.maxParticles)
{
    makeReconstructions();
    Flattening::New(options.parametrization.flattening); // throws for unknown names
    options_.matching.nThreads = options.nThreads;
    options_.transfer.nThreads = options.nThreads;
    options_.integration.nThreads = options.nThreads;
}

StabilityTracker::~StabilityTracker() = default;

void StabilityTracker::makeReconstructions()
{
    options_.reconstruction.nThreads = options_.nThreads;
    reconstructions_.push_back(Reconstruction::New(options_.reconstruction));
    scalar before = -VGREAT;
    for (ReconstructionFrom& later : options_.later)
    {
        if (!(later.from > before))
        {
            throw BadInput("The times from which on other reconstructions apply must "
                           "ascend.");
        }
        before = later.from;
        later.reconstruction.nThreads = options_.nThreads;
        reconstructions_.push_back(Reconstruction::New(later.reconstruction));
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

IntegrationCounts
StabilityTracker::advanceAll(UList<Pathline>& paths, const Velocity& velocity) const
{
    IntegrationCounts counts;
    const auto advanceHere = [&](UList<Pathline>& here)
    { add(counts, stability::advance(here, velocity, options_.integration)); };
    advanceHere(paths);
    exchange_.travel(paths, advanceHere);
    return counts;
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
    const auto velocity =
        std::make_shared<const PointVelocity>(snapshot, options_.wallVelocity);
    const VelocityInterval interval(latestVelocity_, velocity);
    {
        Stopwatch watch(timings_.advection);
        add(surfaceCounts_, advanceAll(pathlines_, interval));
    }
    {
        Stopwatch watch(timings_.particles);
        List<Pathline> paths(particles_.paths());
        add(particleCounts_, advanceAll(paths, interval));
        particles_.setPaths(paths);
    }
    latest_ = std::move(snapshot);
    latestVelocity_ = velocity;
}

void StabilityTracker::placeTimeSurface()
{
    const CellComplex& complex = *latest_->complex;
    forAll(pathlines_, pointi)
    {
        const Pathline& path = pathlines_[pointi];
        timeSurface_.points[pointi] = path.x;
        if (path.hint.cell >= 0)
        {
            timeSurface_.cells[pointi] = path.hint.cell;
            timeSurface_.cellSizes[pointi] = complex.cellSizes()[path.hint.cell];
        }
    }
}

StabilityTracker::SmallScales StabilityTracker::smallScales(const InterfaceMesh& mesh)
{
    Stopwatch watch(timings_.matching);
    const labelList components(pointComponents(mesh));
    SmallScales scales;
    scales.thin = thinPoints(mesh, options_.nThreads);
    scales.droplets = subGridDroplets(mesh, components, *latest_);
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
    forAll(mesh.points, pointi)
    {
        Pathline path;
        path.id = pointi;
        path.x = mesh.points[pointi];
        path.time = latest_->time;
        path.hint.cell = mesh.cells[pointi];
        pathlines_.append(path);
    }
}

// Remeshing moves points into cells next to those of the interface.
void StabilityTracker::findCells(InterfaceMesh& surface) const
{
    const CellComplex& complex = *latest_->complex;
    forAll(surface.points, pointi)
    {
        label& celli = surface.cells[pointi];
        if (!complex.holds(celli, surface.points[pointi]))
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
        Stopwatch watch(timings_.parametrization);
        result_.parametrization =
            parametrize(exchange_.gather(mesh), options_.parametrization);
    }
    InterfaceMesh& surface = result_.parametrization->surface;
    findCells(surface);
    chart_ = StartChart(surface);
    seedPathlines(surface, smallScales(surface));
    parametrized_ = true;
}

ReconstructionResult StabilityTracker::extract()
{
    Stopwatch watch(timings_.reconstruction);
    const ReconstructionOptions* options = &options_.reconstruction;
    std::size_t present = 0;
    while (present < options_.later.size()
           && hasBegun(options_.later[present].from, latest_->time))
    {
        options = &options_.later[present].reconstruction;
        ++present;
    }
    ReconstructionResult result(reconstructions_[present]->extract(*latest_));
    result_.statistics.noiseFloor = noiseFloor(result, *latest_, *options);
    return result;
}

// What noise leaves of the classes.
void StabilityTracker::rateClasses()
{
    for (ClassifiedSurface* surface : {&result_.interface, &result_.timeSurface})
    {
        surface->confidence = confidences(
            *surface, options_.matching.epsilon, result_.statistics.noiseFloor
        );
    }
}

// Steps 4 and 5 of the method: both surfaces against each other, p to the new one.
void StabilityTracker::compare(const InterfaceMesh& extracted)
{
    const scalar radius = options_.matching.searchRadius
                          * max(largestCell(extracted), largestCell(timeSurface_));
    const InterfaceMesh timeSurface(exchange_.share(timeSurface_, extracted, radius));
    const MatchTarget target(timeSurface, options_.matching);
    InterfaceMesh mesh(extracted);
    List<Match> onInterface;
    List<Match> onTimeSurface;
    {
        Stopwatch watch(timings_.matching);
        const InterfaceMesh interface(exchange_.share(mesh, timeSurface_, radius));
        const MatchTarget interfaceTarget(interface, options_.matching);
        onTimeSurface = matchPoints(timeSurface_, interfaceTarget, options_.matching);
        onInterface = matchPoints(mesh, target, options_.matching);
    }
    {
        Stopwatch watch(timings_.transfer);
        result_.transfer =
            transfer(mesh, onInterface, target, options_.transfer, chart_);
    }
    const CellComplex& complex = *latest_->complex;
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
        timeSurface_, detached, result_.timeSurface.components, *latest_->complex,
        latest_->time
    );
    result_.nSkippedParticles = particles_.nSkipped();
}

void StabilityTracker::takeStock(const ReconstructionResult& extracted)
{
    Statistics& statistics = result_.statistics;
    statistics.time = latest_->time;
    statistics.interval = latest_->time - lastClassified_;
    statistics.volumeError = extracted.volumeError();
    result_.nFailedCells = extracted.nFailed;
    result_.volumeFit = extracted.volumeFit;
    statistics.nParticles = particles_.size();
    statistics.nMerged = result_.transfer.nMerged;
    statistics.nSplit = result_.transfer.nSplit;
    survey(
        statistics, result_.interface, result_.timeSurface, options_.matching.epsilon
    );
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
            describe(timeSurface_, atHome, Stability::stable, *latest_->complex, 0);
        result_.timeSurface.thin = seedScales_.thin;
        result_.timeSurface.subGrid = seedScales_.subGrid;
    }
}

const Classification& StabilityTracker::classify()
{
    result_ = Classification();
    result_.index = nClassified_;
    result_.timeSurfaceCounts = std::exchange(surfaceCounts_, {});
    result_.particleCounts = std::exchange(particleCounts_, {});

    const ReconstructionResult extracted(extract());
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

    lastClassified_ = latest_->time;
    ++nClassified_;
    return result_;
}

} // namespace Foam::stability
