// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/case/CaseChecks.H"

#include "core/base/Errors.H"
#include "IOdictionary.H"
#include "OSspecific.H"
#include "fileOperation.H"
#include "fvMesh.H"
#include "processorPolyPatch.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

void refuseOnePart(const fvMesh& mesh)
{
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (isA<processorPolyPatch>(patch) && !UPstream::parRun())
        {
            throw BadInput(
                "The case " + mesh.time().caseName()
                + " is one part of a decomposed case (its patch " + patch.name()
                + " leads to another): run 'mpirun -np <number of parts> "
                  "interfaceStability -parallel' on the whole, or reconstructPar first."
            );
        }
    }
}

void refuseLocalTimeSteps(const fvMesh& mesh)
{
    const auto* schemes = mesh.findObject<IOdictionary>("fvSchemes");
    const dictionary inTime(
        schemes ? schemes->subOrEmptyDict("ddtSchemes") : dictionary()
    );
    const entry* standard = inTime.findEntry("default");
    if (standard && standard->isStream() && !standard->stream().empty()
        && standard->stream()[0].isWord()
        && standard->stream()[0].wordToken() == "localEuler")
    {
        throw BadInput(
            "The times of this case are iterations: ddtSchemes has 'default "
            "localEuler', by which each cell has a time step of its own, so that "
            "nothing can be followed with the flow; allowed are schemes with one time "
            "for all cells."
        );
    }
}

// The area vectors of the faces of a closed cell have no sum, whatever its shape.
void refuseOpenCells(const fvMesh& mesh)
{
    constexpr scalar roundOff = 1e-6;
    vectorField sums(mesh.nCells(), Zero);
    scalarField sizes(mesh.nCells(), Zero);
    const auto add = [&](label celli, const vector& area)
    {
        sums[celli] += area;
        sizes[celli] += mag(area);
    };
    const vectorField& areas = mesh.faceAreas();
    forAll(areas, facei)
    {
        add(mesh.faceOwner()[facei], areas[facei]);
        if (mesh.isInternalFace(facei))
        {
            add(mesh.faceNeighbour()[facei], -areas[facei]);
        }
    }
    forAll(sums, celli)
    {
        if (!(mag(sums[celli]) <= roundOff * sizes[celli]))
        {
            throw BadInput(
                "Cell " + std::to_string(celli) + " of the mesh, at "
                + textOf(mesh.cellCentres()[celli])
                + ", is not closed by its faces: checkMesh tells more."
            );
        }
    }
}

} // namespace

void checkTimes(const instantList& times)
{
    for (const instant& time : times)
    {
        if (!std::isfinite(time.value()))
        {
            throw BadInput(
                "The case has a folder " + time.name()
                + ", whose name OpenFOAM takes for a time: rename or remove it."
            );
        }
    }
}

std::string decomposedWayOut(const Time& runTime)
{
    const label nParts = UPstream::parRun() ? 0 : fileHandler().nProcs(runTime.path());
    if (nParts == 0)
    {
        return "";
    }
    const std::string n = std::to_string(nParts);
    return "the case is decomposed into " + n + " parts; run 'mpirun -np " + n
           + " interfaceStability -parallel', or reconstructPar first.";
}

void checkMeshFiles(const Time& runTime, const word& region)
{
    const word inRegion = region == polyMesh::defaultRegion ? word() : region;
    const fileName local(inRegion / polyMesh::meshSubDir);
    const std::string out = decomposedWayOut(runTime);
    if (!out.empty()
        && runTime.findInstance(local, "faces", IOobject::READ_IF_PRESENT)
               == runTime.constant()
        && !isFile(runTime.path() / runTime.constant() / local / "faces"))
    {
        throw BadInput(
            "There is no mesh in " + runTime.constant() / local + ": " + out
        );
    }
}

void checkMeshTimes(const polyMesh& mesh, const Exchange& exchange)
{
    std::string here;
    runOnAllRanks(
        exchange,
        [&]
        {
            for (const char* file : {"points", "faces"})
            {
                here += mesh.time().findInstance(
                            mesh.meshDir(), file, IOobject::READ_IF_PRESENT
                        )
                        + ' ';
            }
        }
    );
    Packet packet;
    packet.putString(here);
    const std::string masters = exchange.fromMaster(packet).getString();
    exchange.throwIfAny<BadInput>(
        here == masters ? ""
                        : "At time " + mesh.time().timeName()
                              + " the ranks have points and faces of the mesh of "
                                "different times: "
                              + masters + "and " + here
                              + "; allowed are the same ones on all ranks."
    );
}

void checkCase(const fvMesh& mesh, const Exchange& exchange)
{
    runOnAllRanks(
        exchange,
        [&]
        {
            refuseOnePart(mesh);
            refuseLocalTimeSteps(mesh);
            refuseOpenCells(mesh);
        }
    );
}

} // namespace Foam::stability
