// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/ranks/CoupledPoints.H"

#include "processorPolyPatch.H"
#include "syncTools.H"

namespace Foam::stability
{

CoupledPoints::CoupledPoints(
    const polyMesh& mesh, const CellComplexInput& own, const CyclicPatches& cyclic,
    const RankMessages& messages
)
    : mesh_(mesh), own_(own), cyclic_(cyclic), exchange_(messages),
      local_(messages.numbersOf(own.points.size()))
{
}

labelList CoupledPoints::numbers() const
{
    labelList numbers(own_.points.size());
    forAll(numbers, pointi)
    {
        numbers[pointi] = local_.toGlobal(pointi);
    }
    spreadLowest(numbers, false);
    return numbers;
}

labelList CoupledPoints::homePoints(const labelList& numbers) const
{
    labelList home(numbers);
    spreadLowest(home, true);
    return home;
}

pointField
CoupledPoints::homesOf(const labelList& numbers, const labelList& homePoints) const
{
    pointField homes(own_.points);
    forAll(homes, pointi)
    {
        if (numbers[pointi] != homePoints[pointi])
        {
            homes[pointi] = point::max;
        }
    }
    spreadLowest(homes, true);
    return homes;
}

// Calls visit(f, i) for the faces between ranks and, if wanted, those of cyclic
// patches; i counts all boundary faces.
template<class Visit>
void CoupledPoints::visitFaces(bool throughCyclic, const Visit& visit) const
{
    for (const polyPatch& patch : mesh_.boundaryMesh())
    {
        if (cyclic_.contain(patch) ? throughCyclic
                                   : bool(isA<processorPolyPatch>(patch)))
        {
            for (label i = 0; i < patch.size(); ++i)
            {
                const label facei = patch.start() + i;
                visit(own_.faces[facei], facei - mesh_.nInternalFaces());
            }
        }
    }
}

// Each point takes the lowest of the values of the points that are one with it.
template<class Value>
void CoupledPoints::spreadLowest(List<Value>& values, bool throughCyclic) const
{
    const auto take = [](Value& here, const Value& there) { here = there; };
    const auto asTheyAre = [](const auto&, auto&) {};
    label mostPoints = 0;
    visitFaces(
        true, [&](const face& f, label) { mostPoints = max(mostPoints, f.size()); }
    );
    exchange_.meet();
    reduce(mostPoints, maxOp<label>());
    bool changed = true;
    while (exchange_.total(changed) > 0)
    {
        changed = false;
        for (label k = 0; k < mostPoints; ++k)
        {
            List<Value> onFaces(mesh_.nFaces() - mesh_.nInternalFaces(), Zero);
            visitFaces(
                throughCyclic,
                [&](const face& f, label i) { onFaces[i] = values[f[k % f.size()]]; }
            );
            exchange_.meet();
            syncTools::syncBoundaryFaceList(mesh_, onFaces, take, asTheyAre);
            visitFaces(
                throughCyclic,
                [&](const face& f, label i)
                {
                    // The other side lists them backwards from the same first point.
                    const label pointi = f[(f.size() - k % f.size()) % f.size()];
                    const Value lowest(min(values[pointi], onFaces[i]));
                    changed = changed || lowest != values[pointi];
                    values[pointi] = lowest;
                }
            );
        }
    }
}

} // namespace Foam::stability
