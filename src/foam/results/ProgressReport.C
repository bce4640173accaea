// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/results/ProgressReport.H"

#include "foam/results/TwoDigits.H"
#include "messageStream.H"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace Foam::stability
{

namespace
{

// Epsilon should be at least so many times the noise floor.
constexpr scalar floorsPerEpsilon = 2;

// What share of M is stable and what share of T was kept; nothing of nothing.
std::string shares(const Statistics& s)
{
    std::ostringstream text;
    text << std::setprecision(3);
    if (s.area > 0)
    {
        text << 100 * s.stableFraction() << " % stable, ";
    }
    if (s.area + s.timeSurfaceArea + s.leftArea > 0)
    {
        text << 100 * s.keptFraction() << " % kept, ";
    }
    return text.str();
}

} // namespace

void ProgressReport::classified(
    const Classification& c, const word& timeName, scalar seconds,
    const TrackerOptions& options
)
{
    ++nClassified_;
    if (shown_)
    {
        showProgress(c, timeName, seconds);
        showDetails(c);
    }
    showTroubles(c, timeName);
    warn(c, timeName, options);
}

void ProgressReport::showProgress(
    const Classification& c, const word& timeName, scalar seconds
) const
{
    const Statistics& s = c.statistics;
    std::ostringstream line;
    line << std::setprecision(3) << "interfaceStability: step " << nClassified_;
    if (nExpected_ > 0)
    {
        line << " of " << nExpected_;
    }
    line << ", time " << timeName << " s: " << s.nVertices << " vertices, " << shares(s)
         << s.detachedArea() << " m2 detached, " << s.nParticles << " particles; moved "
         << s.displacement << " cells (largest " << s.largestDisplacement
         << "), epsilon/interval " << s.smallestVisibleDrift() << " m/s, noise floor "
         << s.noiseFloor << " cells; " << seconds << " s";
    if (nExpected_ > nClassified_)
    {
        const scalar left = seconds / nClassified_ * (nExpected_ - nClassified_);
        line << ", about " << label(std::ceil(left)) << " s left";
    }
    Info << line.str().c_str() << endl;
}

void ProgressReport::showDetails(const Classification& c) const
{
    const Statistics& s = c.statistics;
    if (s.nTriangles == 0 && s.detachedArea() + s.leftArea > 0)
    {
        Info << "    there is no interface any more: of the last one " << s.leftArea
             << " m2 left the domain and " << s.detachedArea() << " m2 detached"
             << endl;
    }
    else if (s.nTriangles == 0)
    {
        Info << "    there is no interface at this time" << endl;
    }
    if (c.parametrization)
    {
        const ParametrizationResult& p = *c.parametrization;
        Info << "    parametrized: " << p.nCharts << " charts, remeshed within "
             << p.remeshingDistance << " m; " << p.nKept
             << " too small or not fit to be remeshed" << endl;
    }
    if (c.transfer.nUnresolved > 0)
    {
        Info << "    " << c.transfer.nUnresolved << " of " << c.transfer.nCrossing
             << " triangles on seams could not be split" << endl;
    }
}

// Sprays have thousands of patches: the first ones tell enough.
void ProgressReport::showFallbacks(const ParametrizationResult& p, const word& timeName)
{
    constexpr label mostShown = 20;
    label nFallbacks = 0;
    for (const ChartReport& chart : p.charts)
    {
        if (!chart.fallback.empty() && nFallbacks++ < mostShown)
        {
            Info << "interfaceStability: at time " << timeName << " s patch "
                 << chart.patch << " of " << p.nPatches << " (" << chart.nTriangles
                 << " triangles, around " << chart.centre
                 << "): " << chart.fallback.c_str() << endl;
        }
    }
    if (nFallbacks > mostShown)
    {
        Info << "interfaceStability: and " << nFallbacks - mostShown
             << " patches more that were not treated as asked" << endl;
    }
}

void ProgressReport::showTroubles(const Classification& c, const word& timeName) const
{
    if (c.parametrization)
    {
        showFallbacks(*c.parametrization, timeName);
    }
    if (c.impulsiveStart)
    {
        Info << "interfaceStability: at the first time the fluid is at rest, but the "
             << "interface moved as if it had the velocity of the second time from the "
             << "start: that is taken for the first interval" << endl;
    }
    if (c.nFailedCells > 0)
    {
        Info << "interfaceStability: at time " << timeName << " s " << c.nFailedCells
             << " cells with an interface have no piece of it: no plane was found"
             << endl;
    }
    if (c.volumeFit && c.volumeFit->nStayed() > 0)
    {
        const VolumeFitResult& fit = *c.volumeFit;
        Info << "interfaceStability: at time " << timeName << " s " << fit.nStayed()
             << " of " << fit.nClosed
             << " closed components keep their volume: " << fit.nTooFar
             << " would have to move too far, " << fit.nFolded << " would fold, "
             << fit.nOpen << " share fluid with what is not closed, " << fit.nHeld
             << " are held by walls" << endl;
    }
    if (c.nTornEdges > 0)
    {
        Info << "interfaceStability: at time " << timeName << " s " << c.nTornEdges
             << " edges of the interface within the domain have one triangle" << endl;
    }
    const IntegrationCounts& surface = c.timeSurfaceCounts;
    const IntegrationCounts& particles = c.particleCounts;
    if (surface.nStuck + surface.nLost + particles.nStuck + particles.nLost > 0)
    {
        Info << "interfaceStability: at time " << timeName << " s of the interface "
             << surface.nStuck << " points are stuck, " << surface.nLost
             << " lost; of the particles " << particles.nStuck << " stuck, "
             << particles.nLost << " lost. " << c.statistics.untrackedArea
             << " m2 around such points of the interface have no match: untracked, "
                "not detached"
             << endl;
    }
}

void ProgressReport::warn(
    const Classification& c, const word& timeName, const TrackerOptions& options
)
{
    if (c.nSkippedParticles > 0 && !warnedParticles_)
    {
        warnedParticles_ = true;
        Warning << "interfaceStability: at time " << timeName
                << " s the particles reached maxParticles (" << options.maxParticles
                << "): " << c.nSkippedParticles
                << " found no room, and no more will be seeded. Told once." << endl;
    }
    warnOfNoise(c, timeName);
    warnOfTears(c, timeName);
    intervals_.classified(c.statistics, timeName);
}

void ProgressReport::warnOfTears(const Classification& c, const word& timeName)
{
    if (c.nTornEdges > 0 && !warnedTorn_)
    {
        warnedTorn_ = true;
        Warning
            << "interfaceStability: at time " << timeName
            << " s the interface is torn within the domain, at " << c.nTornEdges
            << " edges, where it should be closed: what lies there may be classified "
               "wrongly. This is a fault of the program; please report the case. Told "
               "once; later times only count."
            << endl;
    }
}

void ProgressReport::warnOfNoise(const Classification& c, const word& timeName)
{
    const Statistics& s = c.statistics;
    const scalar least = floorsPerEpsilon * s.noiseFloor; // [cells]
    if (warnedNoise_ || s.epsilonCells <= 0 || s.epsilonCells >= least)
    {
        return;
    }
    warnedNoise_ = true;
    const scalar better = roundedUp(c.epsilon.value * least / s.epsilonCells);
    Warning << "interfaceStability: at time " << timeName << " s epsilon ("
            << s.epsilonCells << " cells) is below twice the noise floor of the "
            << "reconstruction (" << s.noiseFloor
            << " cells): part of what attaches and detaches is noise. Better is "
            << (c.epsilon.relative ? "epsilon " : "epsilonAbsolute ") << better
            << ". Told once; see the column noiseFloor of stability.dat." << endl;
}

} // namespace Foam::stability
