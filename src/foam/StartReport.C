// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/StartReport.H"

#include "core/base/Errors.H"
#include "core/base/Version.H"
#include "foam/entries/EntryChoices.H"
#include "OSspecific.H"
#include "fvMesh.H"
#include "unitConversion.H"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Foam::stability
{

namespace
{

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

std::string textOf(const ReconstructionOptions& options, const Epsilon& epsilon)
{
    std::ostringstream text;
    text << options.method << " reconstruction, sharpening "
         << sharpeningNames()[label(options.sharpening)] << ", volumeFit "
         << volumeFitNames()[label(options.volumeFit)] << ", epsilon " << epsilon.value
         << (epsilon.relative ? " cells" : " m");
    return text.str();
}

void tellDetails(
    const CaseSnapshots& snapshots, const TrackerOptions& options,
    const fileName& results
)
{
    const CaseFields& fields = snapshots.fields();
    const FaceFlux& flux = snapshots.flux();
    Info << generator().c_str() << ":" << nl << "    fields " << fields.alphaName()
         << " (from " << fields.source().c_str() << ") and " << fields.UName() << nl
         << "    velocity " << (flux.kind() == VelocityKind::flux ? "flux: " : "U: ")
         << flux.reason().c_str() << nl << "    "
         << textOf(options.reconstruction, options.matching.epsilon).c_str() << ", "
         << options.nThreads << " threads" << nl;
    for (const ReconstructionFrom& later : options.later)
    {
        Info << "    from " << later.from << " s on "
             << textOf(later.reconstruction, later.matching.epsilon).c_str() << nl;
    }
    if (snapshots.section())
    {
        Info << "    " << description(*snapshots.section()).c_str() << nl;
    }
    if (!results.empty())
    {
        Info << "    results in " << results << nl;
    }
    Info << endl;
}

void tellPatches(const CaseSnapshots& snapshots)
{
    for (const WallPatch& wall : snapshots.walls())
    {
        Info << "interfaceStability: patch " << wall.name
             << " is taken for a wall: its velocity (" << wall.condition
             << ") runs along it" << nl << endl;
    }
    for (const std::string& patch : snapshots.openCoupled())
    {
        Info << "interfaceStability: patch " << patch.c_str()
             << " is taken for an open boundary: pathlines that cross it end there"
             << nl << endl;
    }
}

// The two times with the longest interval between them, if that is much longer than
// most intervals are; else empty.
wordList longestGap(const instantList& times)
{
    constexpr scalar muchLonger = 1.9;
    const label n = times.size() - 1; // number of intervals
    label longest = 0;
    scalarList lengths(max(n, label(0)));
    forAll(lengths, i)
    {
        lengths[i] = times[i + 1].value() - times[i].value();
        longest = lengths[i] > lengths[longest] ? i : longest;
    }
    if (n < 2)
    {
        return wordList();
    }
    const label middle = (n - 1) / 2; // of two the shorter
    const scalar length = lengths[longest];
    std::nth_element(lengths.begin(), lengths.begin() + middle, lengths.end());
    return length > muchLonger * lengths[middle]
               ? wordList{times[longest].name(), times[longest + 1].name()}
               : wordList();
}

void tellTimes(const CaseSnapshots& snapshots, const instantList& times)
{
    if (!snapshots.passedOver().empty())
    {
        Info << "interfaceStability: times without " << snapshots.fields().alphaName()
             << " or " << snapshots.fields().UName()
             << " are passed over: " << listed(snapshots.passedOver()).c_str() << nl
             << endl;
    }
    const wordList gap(longestGap(times));
    if (!gap.empty())
    {
        Info << "interfaceStability: the interval from time " << gap[0] << " to "
             << gap[1]
             << " is much longer than others, as if times were missing; it is "
             << "taken as one: select times before or after it, or write them all" << nl
             << endl;
    }
}

// A solver that was stopped and started again leaves one folder for each start.
void tellEarlierRuns(const Time& runTime, const fileName& results)
{
    wordList earlier;
    for (const fileName& folder : readDir(results.path(), fileName::DIRECTORY))
    {
        scalar start = 0;
        if (readScalar(folder, start) && start < runTime.timeOutputValue())
        {
            earlier.append(folder);
        }
    }
    if (!earlier.empty())
    {
        Info
            << "interfaceStability: this run begins anew at time " << runTime.timeName()
            << ", with parameters, histories and particles of its own: results of runs "
            << "that began earlier are beside its folder, from time "
            << listed(earlier).c_str() << nl << endl;
    }
}

} // namespace

void tellStart(
    const fvMesh& mesh, const CaseSnapshots& snapshots, const Controls& controls,
    const instantList& times, const fileName& results, bool details
)
{
    const Time& runTime = mesh.time();
    if (details)
    {
        tellDetails(
            snapshots, controls.tracker,
            results.empty() ? results : runTime.relativePath(results)
        );
    }
    tellTimes(snapshots, times);
    if (!results.empty())
    {
        tellEarlierRuns(runTime, results);
    }
    tellPatches(snapshots);
}

} // namespace Foam::stability
