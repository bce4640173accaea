// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/AnalysisSession.H"

#include "core/Errors.H"
#include "fvMesh.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

// Beyond so many cells between classifications p is resampled from afar.
constexpr scalar largestDisplacement = 2.5;

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
      fields_(mesh, controls.alpha, controls.U), snapshots_(mesh),
      tracker_(controls.tracker, exchange_)
{
}

void AnalysisSession::expect(const instantList& times)
{
    if (times.size() < 2)
    {
        throw BadInput(
            "The times selected are " + std::to_string(times.size())
            + ", but the analysis compares consecutive times and needs at least two: "
              "check the time options and the time folders of the case."
        );
    }
    fields_.require(times);
    nExpected_ = times.size();
}

std::shared_ptr<const FlowSnapshot> AnalysisSession::takeSnapshot()
{
    const clockTime clock;
    const std::string missing = fields_.missing();
    if (!missing.empty())
    {
        throw BadInput(missing);
    }
    const tmp<volScalarField> alpha(fields_.alpha());
    const tmp<volVectorField> U(fields_.U());
    auto snapshot = snapshots_.take(alpha(), U(), fields_.time());
    readingSeconds_ += clock.elapsedTime();
    return snapshot;
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
    if (!tracker_.started() || (nClassified_ > 0 && classifiedTime_ == tracker_.time()))
    {
        return;
    }
    const Classification& classification = tracker_.classify();
    checkFinite(classification.statistics.values(), Statistics::columns());
    classifiedTime_ = tracker_.time();
    ++nClassified_;
    write(classification);
    reportProgress(classification);
    warn(classification);
}

void AnalysisSession::write(const Classification& classification)
{
    const clockTime clock;
    folder_->write(classification, tracker_.particles());
    writingSeconds_ += clock.elapsedTime();
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

void AnalysisSession::announce() const
{
    const TrackerOptions& options = controls_.tracker;
    const Epsilon& epsilon = options.matching.epsilon;
    if (report_)
    {
        Info << "interfaceStability:" << nl << "    fields " << fields_.alphaName()
             << " (from " << fields_.source().c_str() << ") and " << fields_.UName()
             << nl << "    " << options.reconstruction.method.c_str()
             << " reconstruction, epsilon " << epsilon.value
             << (epsilon.relative ? " cells" : " m") << ", " << options.nThreads
             << " threads" << nl << "    results in "
             << mesh_.time().relativePath(folder_->path()) << nl << endl;
    }
}

void AnalysisSession::reportProgress(const Classification& c)
{
    if (!report_)
    {
        return;
    }
    const Statistics& s = c.statistics;
    const scalar elapsed = clock_.elapsedTime();
    Info << "interfaceStability: step " << nClassified_;
    if (nExpected_ > 0)
    {
        Info << " of " << nExpected_;
    }
    Info << ", time " << s.time << " s: " << s.nVertices << " vertices, "
         << 100 * s.stableFraction() << " % stable, "
         << s.detachedNearWall + s.detachedElsewhere << " m2 detached, " << s.nParticles
         << " particles; moved " << s.displacement << " cells, epsilon/interval "
         << s.drift() << " m/s; " << elapsed << " s";
    if (nExpected_ > nClassified_)
    {
        const scalar left = elapsed / nClassified_ * (nExpected_ - nClassified_);
        Info << ", about " << std::ceil(left) << " s left";
    }
    Info << endl;

    if (c.parametrization)
    {
        const ParametrizationResult& p = *c.parametrization;
        Info << "    parametrized: " << p.nCharts << " charts, " << p.nFallbacks
             << " of them by the fallback of the flattening, " << p.nKept
             << " not remeshed" << endl;
    }
    const IntegrationCounts& surface = c.timeSurfaceCounts;
    const IntegrationCounts& particles = c.particleCounts;
    if (surface.nStuck + surface.nLost + particles.nStuck + particles.nLost > 0)
    {
        Info << "    pathlines stuck " << surface.nStuck << ", lost " << surface.nLost
             << "; particles stuck " << particles.nStuck << ", lost " << particles.nLost
             << endl;
    }
    if (c.transfer.nUnresolved > 0)
    {
        Info << "    triangles whose seam could not be cut: " << c.transfer.nUnresolved
             << " of " << c.transfer.nCrossing << endl;
    }
}

void AnalysisSession::warn(const Classification& c)
{
    const scalar displacement = c.statistics.displacement;
    if (displacement > largestDisplacement && !warnedDisplacement_)
    {
        warnedDisplacement_ = true;
        Warning << "interfaceStability: at time " << c.statistics.time
                << " s the interface had moved " << displacement
                << " cells (rms) since the last classified time; above "
                << largestDisplacement
                << " the results lose accuracy: write times more often. Reported once; "
                   "see the column displacement of stability.dat."
                << endl;
    }
    if (c.nSkippedParticles > 0 && !warnedParticles_)
    {
        warnedParticles_ = true;
        Warning << "interfaceStability: at time " << c.statistics.time
                << " s the number of particles reached maxParticles ("
                << controls_.tracker.maxParticles << "); " << c.nSkippedParticles
                << " found no room, and no more will be seeded. Reported once." << endl;
    }
}

} // namespace Foam::stability
