// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/advection/WayBack.H"

#include "core/flow/Travel.H"

namespace Foam::stability
{

namespace
{

// The end of the way back of a point.
struct Return
{
    label id;
    point x;       // [m]
    vector beyond; // [m], Crossings::beyond
    bool crossed;
};

} // namespace

Crossings wayBack(
    const InterfaceMesh& mesh, const UList<bool>& wanted,
    const VelocityHistory& history, const IntegrationOptions& options,
    const CellComplex& complex, const Exchange& exchange
)
{
    const auto intervals(history.reversed());
    DynamicList<Pathline> paths;
    forAll(wanted, pointi)
    {
        if (wanted[pointi])
        {
            Pathline path;
            path.id = pointi;
            path.home = exchange.rank();
            path.x = path.start = mesh.points[pointi];
            path.time = intervals.front()->startTime();
            path.hint.cell = mesh.cells[pointi];
            paths.append(path);
        }
    }
    disperse(paths, complex, exchange);
    for (const auto& interval : intervals)
    {
        travel(paths, *interval, options, complex, exchange);
    }

    const scalar end = intervals.back()->endTime();
    std::vector<DynamicList<Return>> toRanks(exchange.nRanks());
    for (const Pathline& path : paths)
    {
        const bool crossed = path.state == PathlineState::left;
        toRanks[path.home].append(
            {path.id, path.unwrapped(), crossed ? beyondExit(path, end) : vector(Zero),
             crossed}
        );
    }
    Crossings crossings(mesh.points.size());
    for (const List<Return>& returns : exchange.exchangeLists(toRanks))
    {
        for (const Return& back : returns)
        {
            crossings.crossed[back.id] = back.crossed;
            crossings.ends[back.id] = back.x;
            crossings.beyond[back.id] = back.beyond;
        }
    }
    return crossings;
}

} // namespace Foam::stability
