// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/AnalysisSession.H"

#include "core/Errors.H"
#include "clockTime.H"
#include "fvMesh.H"

#include <cmath>
#include <optional>

namespace Foam::stability
{

namespace
{

// Adds the seconds of its life to a counter.
class Busy
{
public:
    explicit Busy(scalar& seconds) : seconds_(seconds) {}
    ~Busy() { seconds_ += clock_.elapsedTime(); }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;

private:
    scalar& seconds_;
    const clockTime clock_;
};

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
    const fvMesh& mesh, const Controls& controls, const word& name
)
    : mesh_(mesh), controls_(controls), name_(name),
      fields_(mesh, controls.alpha, controls.U),
      flux_(mesh, controls.phi, controls.velocity),
      surfaces_(mesh.time(), controls.files), snapshots_(mesh),
      tracker_(controls.tracker, exchange_)
{
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
    fileName path(mesh_.time().globalPath() / "postProcessing");
    if (mesh_.name() != polyMesh::defaultRegion)
    {
        path = path / mesh_.name();
    }
    return path / name_ / mesh_.time().timeName();
}

void AnalysisSession::advance()
{
    const Busy busy(busySeconds_);
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
        folder_ = std::make_unique<ResultFolder>(resultPath());
        tracker_.start(std::move(snapshot));
        announce();
    }
    else if (fields_.time() != tracker_.time())
    {
        tracker_.advance(takeSnapshot());
    }
}

void AnalysisSession::classify()
{
    if (!tracker_.started() || (anyClassified_ && classifiedTime_ == tracker_.time()))
    {
        return;
    }
    std::optional<Busy> busy(busySeconds_);
    const Classification& classification = tracker_.classify();
    checkFinite(classification.statistics.values(), Statistics::columns());
    statistics_ = classification.statistics;
    classifiedTime_ = tracker_.time();
    anyClassified_ = true;
    write(classification);
    busy.reset();
    progress_.classified(
        classification, mesh_.time().timeName(), busySeconds_, controls_.tracker
    );
}

void AnalysisSession::write(const Classification& classification)
{
    {
        const Busy busy(writingSeconds_);
        folder_->write(classification, tracker_.particles());
    }
    writeTimings(classification);
}

void AnalysisSession::writeTimings(const Classification& classification)
{
    const TrackerTimings& t = tracker_.timings();
    const std::vector<scalar> seconds{
        readingSeconds_, t.reconstruction, t.parametrization, t.advection,
        t.particles,     t.matching,       t.transfer,        writingSeconds_,
    };
    lastSeconds_.resize(seconds.size(), 0);
    std::vector<scalar> since(seconds);
    for (std::size_t i = 0; i < seconds.size(); ++i)
    {
        since[i] -= lastSeconds_[i];
    }
    folder_->writeTimings(
        classification.statistics.time,
        {"reading", "reconstruction", "parametrization", "advection", "particles",
         "matching", "transfer", "writing"},
        since
    );
    lastSeconds_ = seconds;
}

void AnalysisSession::complete() const
{
    if (folder_ && anyClassified_)
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
             << ", volumeFit "
             << volumeFitNames()[label(options.reconstruction.volumeFit)].c_str()
             << ", epsilon " << epsilon.value << (epsilon.relative ? " cells" : " m")
             << ", " << options.nThreads << " threads" << nl;
        for (const ReconstructionFrom& later : options.later)
        {
            const ReconstructionOptions& other = later.reconstruction;
            Info << "    from " << later.from << " s on " << other.method.c_str()
                 << " reconstruction, sharpening "
                 << sharpeningNames()[label(other.sharpening)].c_str() << nl;
        }
        Info << "    results in " << mesh_.time().relativePath(folder_->path()) << nl
             << endl;
    }
}

} // namespace Foam::stability
