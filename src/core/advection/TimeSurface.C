// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/advection/TimeSurface.H"

#include "core/ranks/ExactSum.H"
#include "core/flow/Travel.H"
#include "core/cells/CellPlacement.H"

#include <cmath>

namespace Foam::stability
{

namespace
{

// A pathline as the surface sees it.
struct Arrival
{
    label id;
    point x;         // [m]
    label cell;      // global; -1: none
    scalar cellSize; // [m]
    bool nearWall;
    PathlineState state;
    vector beyond; // [m], Crossings::beyond
};

// The image of the cell in which the pathline would be, had it not been brought back.
label unwrappedCell(const Pathline& path, const CellComplex& complex)
{
    const label cell = complex.globalCell(path.hint.cell);
    const std::shared_ptr<const PeriodicImages>& images = complex.whole().images;
    return images ? images->movedCell(cell, images->indexOf(path.unwrapTransform))
                  : cell;
}

} // namespace

void TimeSurface::send(
    scalar time, const CellComplex& complex, const Exchange& exchange
)
{
    const InterfaceMesh& mesh = piece_.mesh;
    left_ = Crossings(mesh.points.size());
    states_ = List<PathlineState>(mesh.points.size(), PathlineState::moving);
    pathlines_.clear();
    forAll(mesh.points, pointi)
    {
        Pathline path;
        path.id = pointi;
        path.home = exchange.rank();
        path.x = path.start = complex.whole().inMiddle(mesh.points[pointi]);
        path.isPrimary = marks_.isPrimary[pointi];
        path.weight = path.isPrimary ? marks_.areas[pointi] : 0;
        path.time = time;
        path.hint.cell = mesh.cells[pointi];
        pathlines_.append(path);
    }
    disperse(pathlines_, complex, exchange);
}

void TimeSurface::seed(
    const SurfacePiece& piece, const PointMarks& marks, scalar time,
    const CellComplex& complex, const Exchange& exchange
)
{
    piece_ = piece;
    marks_ = marks;
    fillMarks(marks_, piece.mesh.points.size());
    send(time, complex, exchange);
}

void TimeSurface::seedRemeshed(
    const SurfacePiece& piece, const PointMarks& marks, scalar time,
    const CellComplex& complex, const Exchange& exchange
)
{
    seed(piece, marks, time, complex, exchange);
    runOnAllRanks(
        exchange,
        [&]
        {
            for (Pathline& path : pathlines_)
            {
                label& celli = path.hint.cell;
                if (!liesWithin(complex, celli, path.x))
                {
                    celli = complex.findCell(path.x);
                }
            }
        }
    );
    collectPoints(time, complex, exchange);
    send(time, complex, exchange); // some have changed rank
}

IntegrationCounts TimeSurface::advance(
    const Velocity& velocity, const IntegrationOptions& options,
    const CellComplex& complex, const Exchange& exchange
)
{
    return travel(pathlines_, velocity, options, complex, exchange);
}

scalar
TimeSurface::displacement(const CellComplex& complex, const Exchange& exchange) const
{
    List<ExactSum> sums(2);
    for (const Pathline& path : pathlines_)
    {
        if (path.hint.cell >= 0)
        {
            const scalar h = complex.cellSizes()[path.hint.cell];
            sums[0].add(path.weight * magSqr(path.unwrapped() - path.start) / sqr(h));
            sums[1].add(path.weight);
        }
    }
    sum(sums, exchange);
    const scalar weight = sums[1].value();
    return weight > 0 ? std::sqrt(sums[0].value() / weight) : 0;
}

void TimeSurface::collectPoints(
    scalar time, const CellComplex& complex, const Exchange& exchange
)
{
    const std::optional<PlaneSection>& section = complex.whole().section;
    std::vector<DynamicList<Arrival>> toRanks(exchange.nRanks());
    for (const Pathline& path : pathlines_)
    {
        Arrival arrival{};
        const label celli = path.hint.cell;
        arrival.id = path.id;
        arrival.x = path.unwrapped();
        arrival.cell = celli < 0 ? -1 : unwrappedCell(path, complex);
        arrival.cellSize = celli < 0 ? 0 : complex.cellSizes()[celli];
        arrival.nearWall = celli >= 0 && complex.nearWall(celli);
        arrival.state = path.state;
        const bool left = path.state == PathlineState::left;
        arrival.beyond = left ? beyondExit(path, time) : vector(Zero);
        toRanks[path.home].append(arrival);
    }
    for (const List<Arrival>& arrivals : exchange.exchangeLists(toRanks))
    {
        for (const Arrival& arrival : arrivals)
        {
            const point& old = piece_.mesh.points[arrival.id];
            piece_.mesh.points[arrival.id] =
                section ? section->inPlane(arrival.x)
                              + (old & section->normal) * section->normal
                        : arrival.x;
            states_[arrival.id] = arrival.state;
            left_.crossed[arrival.id] = arrival.state == PathlineState::left;
            left_.ends[arrival.id] = piece_.mesh.points[arrival.id];
            left_.beyond[arrival.id] = arrival.beyond;
            if (arrival.cell >= 0)
            {
                piece_.mesh.cells[arrival.id] = arrival.cell;
                piece_.mesh.cellSizes[arrival.id] = arrival.cellSize;
                marks_.nearWall[arrival.id] = arrival.nearWall;
            }
        }
    }
}

void TimeSurface::setSmallScales(const List<bool>& thin, const List<bool>& subGrid)
{
    marks_.thin = thin;
    marks_.subGrid = subGrid;
}

} // namespace Foam::stability
