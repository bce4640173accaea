// SPDX-License-Identifier: GPL-3.0-or-later

/*---------------------------------------------------------------------------*\
Application
    interfaceStability

Group
    grpPostProcessingUtilities

Description
    Follows the material interface of a finished volume-of-fluid run with the flow,
    from one stored time to the next, and tells where it stays an interface
    (stable), where it detaches from the flow (detached) and where new interface
    comes from nowhere (attached). After Obermaier, Chen, Hagen, Joy:
    Visualization of material interface stability.

Usage
    \b interfaceStability [OPTION]

      - \par -dict \<file\>
        Dictionary other than system/interfaceStabilityDict, which may be absent:
        every entry has a default. It is explained, entry by entry, in
        etc/caseDicts/interfaceStabilityDict; -help lists what is allowed.

      - \par -region \<name\>
        Mesh region other than the default one, or that of the dictionary.

      - \par -time \<ranges\>, -latestTime, -noZero
        Times to analyse, by default all; at least two.

      - \par -listColumns
        Lists the columns of the tables: name, unit, meaning. Needs no case.

    The results are in postProcessing/interfaceStability/\<startTime\>: surfaces and
    particles as VTK files, each family with a .vtp.series for ParaView, and tables
    stability.dat, survival.dat, droplets.dat, charts.dat and timing.dat. Those of an
    earlier run from the same start time are put aside in the folder previous there, and
    removed when this run has come to its end.

    With the entry methods of the dictionary every method that it lists is run on the
    same flow, with results in postProcessing/interfaceStability_\<name\>, and
    methods.dat in postProcessing/interfaceStability/\<startTime\> compares them.

    On static meshes, two-dimensional ones and wedges among them; surfaces and
    pathlines go on behind cyclic patches. In parallel with -parallel, on a decomposed
case.

\*---------------------------------------------------------------------------*/

#include "argList.H"
#include "core/base/Version.H"
#include "foam/AnalysisSession.H"
#include "foam/case/CaseChecks.H"
#include "foam/entries/EntryHelp.H"
#include "foam/entries/EntryReaders.H"
#include "foam/entries/Methods.H"
#include "foam/errors/Failures.H"
#include "foam/MethodComparison.H"
#include "foam/results/ColumnHelp.H"
#include "functionObject.H"
#include "fvMesh.H"
#include "timeSelector.H"

using namespace Foam;

namespace
{

const word folderName("interfaceStability");

// The folder holds the results of all start times. It is the one that the function
// object of this name uses, as writeFile::baseFileDir() gives it.
fileName resultFolder(const fvMesh& mesh, const word& name)
{
    const fileName all(mesh.time().globalPath() / functionObject::outputPrefix);
    return (mesh.name() == polyMesh::defaultRegion ? all : all / mesh.name()) / name;
}

// One method over all times. Returns where what compares it with others belongs.
fileName analyse(
    Time& runTime, fvMesh& mesh, const instantList& selected,
    const stability::Method& method, stability::MethodScore& score
)
{
    const word name(
        method.name.empty() ? folderName : word(folderName + '_' + method.name)
    );
    fileName results, compared;
    stability::AnalysisSession session(
        mesh, method.controls, resultFolder(mesh, name), stability::FieldSource::disk
    );
    const instantList times(session.select(selected));
    const stability::RankMessages messages;
    forAll(times, timei)
    {
        runTime.setTime(times[timei], timei);
        stability::checkMeshTimes(mesh, messages);
        const polyMesh::readUpdateState state = mesh.readUpdate();
        if (state != polyMesh::UNCHANGED)
        {
            session.meshChanged(state != polyMesh::POINTS_MOVED);
        }
        if (timei == 0)
        {
            results = session.resultPath();
            compared = results.path().path() / folderName / results.name();
            if (!method.name.empty())
            {
                stability::MethodComparison::prepare(compared, messages);
            }
        }
        session.advance();
        session.classify();
        session.writeFiles();
        score.add(session.statistics());
    }
    session.complete();
    return compared;
}

// All methods of the dictionary over the selected times.
void analyseAll(const argList& args)
{
#include "createTime.H"

    stability::checkTimes(runTime.times());
    const instantList times(
        timeSelector::select(runTime.times(), args, runTime.constant())
    );
    if (!times.empty())
    {
        runTime.setTime(times.first(), 0);
    }

    const dictionary dict(stability::findControlsDict(
        runTime, args.get<fileName>("dict", ""), args.get<word>("region", "")
    ));
    const std::vector<stability::Method> methods(stability::readMethods(dict));
    const word region(args.get<word>("region", stability::readName(dict, "region")));
    stability::checkMeshFiles(runTime, region);
    fvMesh mesh(IOobject(region, runTime.timeName(), runTime, IOobject::MUST_READ));

    stability::MethodComparison comparison;
    fileName comparisonPath;
    for (std::size_t i = 0; i < methods.size(); ++i)
    {
        const stability::Method& method = methods[i];
        if (!method.name.empty())
        {
            Info << "interfaceStability: method " << i + 1 << " of " << methods.size()
                 << ", " << method.name << nl << endl;
        }
        stability::MethodScore score(method.name);
        comparisonPath = analyse(runTime, mesh, times, method, score);
        comparison.add(score);
    }
    if (methods.size() > 1)
    {
        const fileName table(comparisonPath / stability::methodTable().file);
        if (Pstream::master())
        {
            comparison.write(comparisonPath);
        }
        Info << comparison.verdict().c_str() << nl << "The numbers are in "
             << runTime.relativePath(table)
             << "; interfaceStabilityView -batch -methods with this file draws them."
             << nl << endl;
    }
}

} // namespace

int main(int argc, char* argv[])
{
    argList::addNote(stability::generator());
    argList::addNote(
        "Follow the material interface of a volume-of-fluid run with the flow and\n"
        "tell where it is stable, detached or attached.\n"
        "Reads system/interfaceStabilityDict if it is there, the volume fraction, U\n"
        "and phi of the selected times; writes to postProcessing/interfaceStability."
    );
    for (const std::string& note : stability::entryHelp())
    {
        argList::addNote(note);
    }
    timeSelector::addOptions(false, false);
    argList::addBoolOption(
        "listColumns", "List the columns of the tables that are written, and end"
    );
#include "addDictOption.H"
#include "addRegionOption.H"

    argList args(argc, argv);
    if (args.found("listColumns"))
    {
        Info << stability::listOfColumns().c_str() << endl;
        return 0;
    }
    if (!args.checkRootCase())
    {
        FatalError.exit();
    }
    stability::exitOnFailure([&] { analyseAll(args); });
    Info << "End\n" << endl;
    return 0;
}
