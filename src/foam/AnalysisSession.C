// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/AnalysisSession.H"

#include "core/Errors.H"
#include "foam/Busy.H"
#include "fvMesh.H"

#include <cmath>
#include <optional>

namespace Foam::stability
{

namespace
{

void checkFinite(
    const std::vector<scalar>& values, const std::vector<std::string>& columns
)
{
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        if (!std::isfinite(values[i]))
        {
            throw NumericalFailure(
                "The result " + columns[i] + " is not finite: the analysis failed."
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
      fields_(mesh, controls.alpha, controls.U, source),
      flux_(mesh, controls.phi, controls.velocity, source),
      surfaces_(mesh.time(), controls.files), snapshots_(mesh),
      tracker_(observed(controls.tracker), exchange_), seconds_(phaseNames().size(), 0),
      secondsBefore_(seconds_)
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
    forced_.check(phase, fields_.time());
}

void AnalysisSession::expect(const instantList& times)
{
    if (times.size() < 2)
    {
        throw BadInput(
            "Times selected: " + std::to_string(times.size())
            + "; the analysis compares consecutive times and needs at least two: check "
              "the time options and the time folders of the case."
        );
    }
    fields_.require(times);
    flux_.choose(times);
    surfaces_.require(times);
    progress_.expect(times.size());
}

// Where nobody said which times there will be: in a solver, or those on disk from now
// on.
void AnalysisSession::chooseVelocity()
{
    const Time& runTime = mesh_.time();
    DynamicList<instant> times;
    if (!fields_.inMemory())
    {
        for (const instant& time : runTime.times())
        {
            const bool later =
                time.name() != runTime.constant() && time.value() > runTime.value();
            if (later || time.name() == runTime.timeName())
            {
                times.append(time);
            }
        }
    }
    flux_.choose(instantList(times));
}

std::shared_ptr<const FlowSnapshot> AnalysisSession::takeSnapshot()
{
    enter(Phase::reading);
    const Busy busy(readingSeconds_);
    std::shared_ptr<FlowSnapshot> snapshot(takeFields());
    const instant now(mesh_.time().value(), mesh_.time().timeName());
    if (surfaces_.expected(now))
    {
        snapshot->surface = surfaces_.read(now, nTaken_);
    }
    ++nTaken_;
    return snapshot;
}

std::shared_ptr<FlowSnapshot> AnalysisSession::takeFields()
{
    const std::string missing = fields_.missing();
    if (!missing.empty())
    {
        throw BadInput(missing);
    }
    const tmp<volScalarField> alpha(fields_.alpha());
    const tmp<volVectorField> U(fields_.U());
    if (!flux_.chosen())
    {
        chooseVelocity();
    }
    if (flux_.applies())
    {
        const tmp<surfaceScalarField> phi(flux_.get());
        return snapshots_.take(alpha(), U(), fields_.time(), &phi());
    }
    return snapshots_.take(alpha(), U(), fields_.time());
}

fileName AnalysisSession::resultPath() const
{
    return resultFolder_ / mesh_.time().timeName();
}

void AnalysisSession::advance()
{
    const Busy busy(busySeconds_);
    phase_ = Phase::reading;
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
        if (controls_.writeToFile)
        {
            folder_ =
                std::make_unique<ResultFolder>(resultPath(), controls_.writePrecision);
        }
        tracker_.start(std::move(snapshot));
        announce();
    }
    else if (fields_.time() != tracker_.time())
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
    const Busy busy(busySeconds_);
    return tracker_.started() ? tracker_.displacement() : 0;
}

void AnalysisSession::classify()
{
    if (!tracker_.started() || isClassified())
    {
        return;
    }
    std::optional<Busy> busy(busySeconds_);
    latest_ = nullptr;
    const Classification& classification = tracker_.classify();
    checkFinite(classification.statistics.values(), Statistics::columns());
    statistics_ = classification.statistics;
    latest_ = &classification;
    filesWritten_ = false;
    ++nClassified_;
    writeTables();
    busy.reset();
    progress_.classified(
        classification, mesh_.time().timeName(), busySeconds_, controls_.tracker
    );
}

void AnalysisSession::writeTables()
{
    if (!folder_)
    {
        return;
    }
    {
        const Busy busy(writingSeconds_);
        enter(Phase::writing);
        folder_->writeTables(*latest_);
    }
    secondsBefore_ = seconds_;
    writeTimings();
}

void AnalysisSession::writeFiles()
{
    if (!folder_ || !isClassified() || filesWritten_)
    {
        return;
    }
    const Busy busy(busySeconds_);
    filesWritten_ = true;
    const auto itsTurn = [&](label interval)
    { return interval > 0 && latest_->index % interval == 0; };
    {
        const Busy writing(writingSeconds_);
        enter(Phase::writing);
        if (itsTurn(controls_.surfaceInterval))
        {
            folder_->writeSurfaces(*latest_);
        }
        if (itsTurn(controls_.particleInterval))
        {
            folder_->writeParticles(tracker_.particles(), *latest_);
        }
    }
    writeTimings();
}

// The row of the latest classified time, anew where its files came later.
void AnalysisSession::writeTimings()
{
    const TrackerTimings& t = tracker_.timings();
    seconds_ = {readingSeconds_, t.reconstruction, t.parametrization,
                t.advection,     t.particles,      t.matching,
                t.transfer,      t.statistics,     writingSeconds_};
    std::vector<scalar> since(seconds_);
    for (std::size_t i = 0; i < since.size(); ++i)
    {
        since[i] -= secondsBefore_[i];
    }
    folder_->writeTimings(statistics_.time, since);
}

void AnalysisSession::complete() const
{
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
        Info << "interfaceStability:" << nl << "    fields " << fields_.alphaName()
             << " (from " << fields_.source().c_str() << ") and " << fields_.UName()
             << nl << "    velocity "
             << (flux_.kind() == VelocityKind::flux ? "flux: " : "U: ")
             << flux_.reason().c_str() << nl << "    "
             << options.reconstruction.method.c_str() << " reconstruction, sharpening "
             << sharpeningNames()[label(options.reconstruction.sharpening)].c_str()
             << ", epsilon " << epsilon.value << (epsilon.relative ? " cells" : " m")
             << ", " << options.nThreads << " threads" << nl;
        for (const ReconstructionFrom& later : options.later)
        {
            const ReconstructionOptions& other = later.reconstruction;
            Info << "    from " << later.from << " s on " << other.method.c_str()
                 << " reconstruction, sharpening "
                 << sharpeningNames()[label(other.sharpening)].c_str() << nl;
        }
        if (folder_)
        {
            Info << "    results in " << mesh_.time().relativePath(folder_->path())
                 << nl;
        }
        Info << endl;
    }
}

} // namespace Foam::stability
