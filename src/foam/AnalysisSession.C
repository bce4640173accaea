// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/AnalysisSession.H"

#include "core/base/Errors.H"
#include "core/base/ScopedTimer.H"
#include "core/base/Version.H"
#include "core/comparison/StabilityTables.H"
#include "core/ranks/Exchange.H"
#include "fvMesh.H"
#include "unitConversion.H"

#include <cmath>
#include <optional>
#include <sstream>

namespace Foam::stability
{

namespace
{

void checkFinite(const Statistics& statistics)
{
    for (const TableColumn<Statistics>& column : stabilityTable().columns)
    {
        if (!std::isfinite(column.value(statistics)))
        {
            throw NumericalFailure(
                "The result " + column.name + " is not finite: the analysis failed."
            );
        }
    }
}

// How a mesh of one layer of cells is taken, with what it spans across its section.
std::string description(const PlaneSection& section)
{
    std::ostringstream text;
    text << (section.wedge ? "wedge" : "two-dimensional mesh")
         << ": its section across " << textOf(section.normal);
    if (!section.wedge)
    {
        text << ", " << section.meshThickness << " m thick";
        return text.str();
    }
    const scalar angle = 2 * radToDeg(std::atan(section.meshThickness / 2));
    text << ", around the axis " << textOf(section.axis) << " through "
         << textOf(section.axisPoint) << ", " << angle
         << " degrees; areas and volumes are those of the wedge, times " << 360 / angle
         << " for the whole";
    return text.str();
}

} // namespace

AnalysisSession::AnalysisSession(
    const fvMesh& mesh, const Controls& controls, const fileName& folder,
    FieldSource source
)
    : mesh_(mesh), controls_(controls), resultFolder_(folder),
      snapshots_(mesh, controls.fields, controls.tracker, source, messages_),
      tracker_(observed(controls.tracker), messages_)
{
}

TrackerOptions AnalysisSession::observed(const TrackerOptions& options)
{
    TrackerOptions result(options);
    result.entering = [this](Phase phase) { enter(phase); };
    return result;
}

void AnalysisSession::enter(Phase phase)
{
    phase_ = phase;
    forced_.check(phase, time_);
}

void AnalysisSession::expect(const instantList& times)
{
    snapshots_.require(times);
    progress_.expect(times.size());
}

std::shared_ptr<const FlowSnapshot> AnalysisSession::takeSnapshot()
{
    const ScopedTimer busy(timings_.reading);
    runOnAllRanks(messages_, [&] { enter(Phase::reading); });
    return snapshots_.take();
}

fileName AnalysisSession::resultPath() const
{
    return resultFolder_ / mesh_.time().timeName();
}

void AnalysisSession::prepareResults()
{
    path_ = resultPath();
    if (controls_.writeToFile)
    {
        runOnMaster(
            messages_,
            [&] {
                folder_ =
                    std::make_unique<ResultFolder>(path_, controls_.writePrecision);
            }
        );
        series_ = std::make_unique<ResultSeries>(
            path_, controls_.surfaceParts, snapshots_.section(), messages_
        );
    }
}

void AnalysisSession::advance()
{
    runOnAllRanks(messages_, [&] { takeStep(); });
}

void AnalysisSession::takeStep()
{
    const ScopedTimer busy(busySeconds_);
    phase_ = Phase::reading;
    time_ = snapshots_.time();
    if (meshChanged_)
    {
        throw BadInput(
            "The mesh moves or changes, which interfaceStability does not support yet; "
            "allowed is a mesh that stays as it is from the first time to the last."
        );
    }
    if (!tracker_.started())
    {
        auto snapshot = takeSnapshot();
        prepareResults();
        tracker_.start(std::move(snapshot));
        announce();
    }
    else if (time_ != tracker_.time())
    {
        tracker_.advance(takeSnapshot());
    }
}

bool AnalysisSession::isClassified() const
{
    return latest_ && statistics_.time == tracker_.time();
}

scalar AnalysisSession::displacement()
{
    const ScopedTimer busy(busySeconds_);
    return !tracker_.started()
               ? 0
               : makeOnAllRanks(messages_, [&] { return tracker_.displacement(); });
}

void AnalysisSession::classify()
{
    runOnAllRanks(messages_, [&] { compare(); });
}

void AnalysisSession::compare()
{
    if (!tracker_.started() || isClassified())
    {
        return;
    }
    std::optional<ScopedTimer> busy(busySeconds_);
    latest_ = nullptr;
    const Classification& classification = tracker_.classify();
    statistics_ = classification.statistics;
    ++nClassified_;
    latest_ = &classification;
    filesWritten_ = false;
    runOnAllRanks(messages_, [&] { enter(Phase::writing); });
    runOnMaster(
        messages_,
        [&]
        {
            checkFinite(classification.statistics);
            writeTables();
            busy.reset();
            progress_.classified(
                classification, mesh_.time().timeName(), busySeconds_, controls_.tracker
            );
        }
    );
}

void AnalysisSession::writeTables()
{
    if (!folder_)
    {
        return;
    }
    {
        const ScopedTimer busy(timings_.writing);
        folder_->writeTables(*latest_);
    }
    timingRow_.before = timingRow_.now;
    writeTimings();
}

void AnalysisSession::writeFiles()
{
    if (!isClassified() || filesWritten_)
    {
        return;
    }
    const ScopedTimer busy(busySeconds_);
    filesWritten_ = true;
    runOnAllRanks(
        messages_,
        [&]
        {
            enter(Phase::writing);
            writeTurns();
        }
    );
}

void AnalysisSession::writeTurns()
{
    const auto itsTurn = [&](label interval)
    { return series_ && interval > 0 && latest_->index % interval == 0; };
    {
        const ScopedTimer writing(timings_.writing);
        if (itsTurn(controls_.surfaceInterval))
        {
            series_->writeSurfaces(*latest_);
        }
        if (itsTurn(controls_.particleInterval))
        {
            series_->writeParticles(tracker_.particles(), *latest_);
        }
    }
    runOnMaster(messages_, [&] { writeTimings(); });
}

// The row of the latest classified time, anew where its files came later.
void AnalysisSession::writeTimings()
{
    if (!folder_)
    {
        return;
    }
    static_cast<TrackerTimings&>(timings_) = tracker_.timings();
    timingRow_.time = statistics_.time;
    timingRow_.now = timings_;
    folder_->writeTimings(timingRow_);
}

// Each of the two numbers is the largest over all ranks.
void AnalysisSession::tellMessages() const
{
    const label n = max(nClassified_, label(1));
    const scalar messages = returnReduce(messages_.nMessages() / n, maxOp<scalar>());
    const scalar kilobytes =
        returnReduce(messages_.nBytes() / n / 1024, maxOp<scalar>());
    if (progress_.shown())
    {
        Info << "interfaceStability: a rank sent up to " << label(std::ceil(messages))
             << " messages and " << label(std::ceil(kilobytes))
             << " kB per classified time" << endl;
    }
}

void AnalysisSession::complete() const
{
    if (messages_.nRanks() > 1)
    {
        tellMessages();
    }
    if (folder_ && nClassified_ > 0)
    {
        folder_->complete();
    }
}

void AnalysisSession::announce() const
{
    const TrackerOptions& options = controls_.tracker;
    const Epsilon& epsilon = options.matching.epsilon;
    if (progress_.shown())
    {
        const CaseFields& fields = snapshots_.fields();
        const FaceFlux& flux = snapshots_.flux();
        Info << generator().c_str() << ":" << nl << "    fields " << fields.alphaName()
             << " (from " << fields.source().c_str() << ") and " << fields.UName() << nl
             << "    velocity "
             << (flux.kind() == VelocityKind::flux ? "flux: " : "U: ")
             << flux.reason().c_str() << nl << "    "
             << options.reconstruction.method.c_str() << " reconstruction, sharpening "
             << sharpeningNames()[label(options.reconstruction.sharpening)].c_str()
             << ", volumeFit "
             << volumeFitNames()[label(options.reconstruction.volumeFit)].c_str()
             << ", epsilon " << epsilon.value << (epsilon.relative ? " cells" : " m")
             << ", " << options.nThreads << " threads" << nl;
        for (const ReconstructionFrom& later : options.later)
        {
            const ReconstructionOptions& other = later.reconstruction;
            Info << "    from " << later.from << " s on " << other.method.c_str()
                 << " reconstruction, sharpening "
                 << sharpeningNames()[label(other.sharpening)].c_str() << ", epsilon "
                 << later.matching.epsilon.value
                 << (later.matching.epsilon.relative ? " cells" : " m") << nl;
        }
        if (snapshots_.section())
        {
            Info << "    " << description(*snapshots_.section()).c_str() << nl;
        }
        if (controls_.writeToFile)
        {
            Info << "    results in " << mesh_.time().relativePath(path_) << nl;
        }
        Info << endl;
    }
    for (const WallPatch& wall : snapshots_.walls())
    {
        Info << "interfaceStability: patch " << wall.name
             << " is taken for a wall: its velocity (" << wall.condition
             << ") runs along it" << nl << endl;
    }
    for (const std::string& patch : snapshots_.openCoupled())
    {
        Info << "interfaceStability: patch " << patch.c_str()
             << " is taken for an open boundary: pathlines that cross it end there"
             << nl << endl;
    }
}

} // namespace Foam::stability
