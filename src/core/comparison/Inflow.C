// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/comparison/Inflow.H"

#include "core/advection/WayBack.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

List<bool> rimPoints(const MatchTarget& target)
{
    List<bool> onRim(target.mesh().points.size(), false);
    for (const SurfaceEdge& edge : target.topology().edges())
    {
        if (edge.nTriangles == 1)
        {
            onRim[edge.a] = onRim[edge.b] = true;
        }
    }
    return onRim;
}

} // namespace

List<bool> mayHaveEntered(
    const UList<Match>& matches, const MatchTarget& target, bool sharesPoints
)
{
    constexpr scalar roundOff = 1e-6;
    const List<bool> onRim(rimPoints(target));
    List<bool> result(matches.size());
    forAll(matches, i)
    {
        const SurfacePoint& foot = matches[i].nearest;
        // Polygons that do not share points have rims everywhere.
        bool footOnRim = matches[i].stable && sharesPoints;
        for (label k = 0; k < 3 && footOnRim; ++k)
        {
            footOnRim = foot.weights[k] < roundOff
                        || onRim[target.mesh().triangles[foot.triangle][k]];
        }
        result[i] = !matches[i].stable || footOnRim;
    }
    return result;
}

List<bool> enteredBefore(const TimeSurface& timeSurface, const SurfaceHalo& halo)
{
    const InterfaceMesh& mesh = timeSurface.piece().mesh;
    List<bool> entered(mesh.triangles.size(), false);
    forAll(entered, trianglei)
    {
        for (const label pointi : mesh.triangles[trianglei])
        {
            entered[trianglei] = entered[trianglei]
                                 || (timeSurface.marks().fromOutside[pointi]
                                     && !mesh.parametrized(trianglei));
        }
    }
    return halo.triangleValues(entered);
}

void findEntered(
    ClassifiedSurface& interface, const SurfaceHalo& halo, List<bool> mayHaveEntered,
    const Comparison::Setting& setting
)
{
    const InterfaceMesh& mesh = interface.mesh;
    List<bool> wanted(mayHaveEntered);
    for (const triFace& t : mesh.triangles)
    {
        if (mayHaveEntered[t[0]] || mayHaveEntered[t[1]] || mayHaveEntered[t[2]])
        {
            wanted[t[0]] = wanted[t[1]] = wanted[t[2]] = true;
        }
    }
    const Exchange& exchange = setting.run.ranks;
    if (exchange.total(label(std::count(wanted.begin(), wanted.end(), true))) == 0)
    {
        return;
    }
    interface.crossings = wayBack(
        mesh, wanted, *setting.history, setting.integration, setting.complex(), exchange
    );
    forAll(wanted, pointi)
    {
        Stability& stability = interface.stability[pointi];
        bool& crossed = interface.crossings.crossed[pointi];
        // The way of a neighbour only tells where its triangles are cut.
        crossed = crossed && mayHaveEntered[pointi];
        if (stability == Stability::attached && crossed)
        {
            stability = Stability::entered;
            interface.fromOutside[pointi] = true;
        }
    }
    interface.areas = halo.toOwned(pointAreas(
        halo.mesh(),
        halo.triangleValues(cornerShares(mesh.triangles, interface.crossings, true)),
        setting.section()
    ));
}

} // namespace Foam::stability
