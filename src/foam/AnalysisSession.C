// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/AnalysisSession.H"

#include "core/base/Errors.H"
#include "core/base/ScopedTimer.H"
#include "core/comparison/StabilityTables.H"
#include "core/ranks/Exchange.H"
#include "foam/case/CaseChecks.H"
#include "foam/StartReport.H"
#include "fvMesh.H"

#include <cmath>
#include <optional>

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

} // namespace

AnalysisSession::AnalysisSession(
    const fvMesh& mesh, const Controls& controls, const fileName& folder,
    FieldSource source
)
    : mesh_(mesh), controls_(controls), resultFolder_(folder),
      tracker_(observed(controls.tracker), messages_)
{
    runOnAllRanks(
        messages_,
        [&]
        {
            checkCase(mesh, messages_);
            snapshots_ = std::make_unique<CaseSnapshots>(
                mesh, controls.fields, controls.tracker, source, messages_
            );
            points_ = mesh.points();
        }
    );
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

instantList AnalysisSession::select(const instantList& all)
{
    instantList times;
    runOnAllRanks(messages_, [&] { times = snapshots_->select(all); });
    progress_.expect(times.size());
    times_ = times;
    return times;
}

// Motion that is declared may move nothing: the points then are where they were.
void AnalysisSession::meshChanged(bool topology)
{
    constexpr scalar roundOff = 1e-10; // of the size of the domain
    const pointField& points = mesh_.points();
    if (topology || points.size() != points_.size())
    {
        meshChanged_ = true;
        return;
    }
    scalar furthest = 0;
    forAll(points, i)
    {
        furthest = max(furthest, magSqr(points[i] - points_[i]));
    }
    meshChanged_ |= std::sqrt(furthest) > roundOff * mesh_.bounds().mag();
}

std::shared_ptr<const FlowSnapshot> AnalysisSession::takeSnapshot()
{
    const ScopedTimer busy(timings_.reading);
    runOnAllRanks(messages_, [&] { enter(Phase::reading); });
    return snapshots_->take();
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
            path_, folder_ ? &folder_->files() : nullptr, controls_.surfaceParts,
            controls_.parameterSpace, snapshots_->section(), messages_
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
    time_ = snapshots_->time();
    if (meshChanged_)
    {
        throw BadInput(
            "The mesh moves or changes until time " + mesh_.time().timeName()
            + ", which interfaceStability does not support yet; allowed is a mesh that "
              "stays as it is from the first time to the last: where it changes once, "
              "select times after that, for instance with -time '"
            + mesh_.time().timeName() + ":'."
        );
    }
    if (times_.empty() && snapshots_->passesOver())
    {
        return;
    }
    if (!tracker_.started())
    {
        auto snapshot = takeSnapshot();
        prepareResults();
        tracker_.start(std::move(snapshot));
        tellStart(
            mesh_, *snapshots_, controls_, times_, controls_.writeToFile ? path_ : "",
            progress_.shown()
        );
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

void AnalysisSession::complete()
{
    if (messages_.nRanks() > 1)
    {
        tellMessages();
    }
    runOnMaster(
        messages_,
        [&]
        {
            if (folder_ && nClassified_ > 0)
            {
                folder_->files().complete();
            }
            progress_.complete();
        }
    );
}

} // namespace Foam::stability
