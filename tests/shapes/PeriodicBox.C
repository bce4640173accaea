// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/PeriodicBox.H"

#include "core/cells/HomeNumbers.H"
#include "core/cells/RingFetch.H"

#include <cmath>
#include <stdexcept>

namespace Foam::stability::shapes
{

namespace
{

label nearestTo(const point& x, const pointField& places, const labelList& among)
{
    for (const label i : among)
    {
        if (mag(places[i] - x) < 1e-9)
        {
            return i;
        }
    }
    throw std::logic_error("the sides of the pair do not fit");
}

// Labels among the boundary faces.
labelList facesOf(const CellComplexInput& box, label patchi)
{
    DynamicList<label> faces;
    forAll(box.patches, i)
    {
        if (box.patches[i] == patchi)
        {
            faces.append(i);
        }
    }
    return labelList(std::move(faces));
}

labelList pointsOf(const CellComplexInput& box, const labelList& boundaryFaces)
{
    labelHashSet points;
    for (const label i : boundaryFaces)
    {
        points.insert(box.faces[box.neighbour.size() + i]);
    }
    return points.sortedToc();
}

// The lowest point of those that are one, by walking through the pairs.
labelList
lowestPoints(const CellComplexInput& box, const std::vector<CyclicPair>& pairs)
{
    labelList lowest(identity(box.points.size()));
    for (std::size_t n = 0; n <= pairs.size(); ++n)
    {
        for (const CyclicPair& pair : pairs)
        {
            const labelList there(pointsOf(box, facesOf(box, pair.second)));
            for (const label pointi : pointsOf(box, facesOf(box, pair.first)))
            {
                const label other = nearestTo(
                    pair.motion.inverse()(box.points[pointi]), box.points, there
                );
                lowest[pointi] = lowest[other] = min(lowest[pointi], lowest[other]);
            }
        }
    }
    return lowest;
}

} // namespace

CyclicPair periodicInX(const BoxOptions& options)
{
    RigidMotion motion;
    motion.shift.x() = options.min.x() - options.max.x();
    return {0, 1, motion};
}

CyclicPair periodicInAngle(scalar angle)
{
    RigidMotion motion;
    const scalar c = std::cos(angle), s = std::sin(-angle);
    motion.rotation = tensor(c, -s, 0, s, c, 0, 0, 0, 1);
    return {2, 3, motion};
}

PeriodicPiece periodicPiece(CellComplexInput box, const std::vector<CyclicPair>& pairs)
{
    const CellComplex whole(box);
    const label nInternal = box.neighbour.size();
    std::vector<RigidMotion> motions;
    for (const CyclicPair& pair : pairs)
    {
        motions.push_back(pair.motion);
    }
    PeriodicPiece piece;
    piece.images = std::make_shared<const PeriodicImages>(
        motions, whole.bounds(), whole.nCells(), whole.nPoints()
    );
    box.globalCells = identity(whole.nCells());
    box.globalPoints = identity(whole.nPoints());
    box.globalBoundaryFaces = identity(box.kinds.size());
    box.cellBehind = labelList(box.kinds.size(), -1);
    const labelList lowest(lowestPoints(box, pairs));

    const pointField centres(
        SubList<point>(whole.faceCentres(), whole.nBoundaryFaces(), nInternal)
    );
    const auto lead = [&](label from, label to, const RigidMotion& motion)
    {
        const labelList there(facesOf(box, to));
        for (const label i : facesOf(box, from))
        {
            const label other = nearestTo(motion.inverse()(centres[i]), centres, there);
            box.cellBehind[i] = piece.images->cell(
                box.owner[nInternal + other], piece.images->indexOf(motion)
            );
        }
    };
    for (const CyclicPair& pair : pairs)
    {
        lead(pair.first, pair.second, pair.motion);
        lead(pair.second, pair.first, pair.motion.inverse());
    }
    forAll(box.cellBehind, i)
    {
        if (box.cellBehind[i] >= 0)
        {
            box.kinds[i] = BoundaryKind::coupledUnknown;
            box.patches[i] = -1;
        }
    }
    numberFromHome(box, lowest, pointField(box.points, lowest), *piece.images);
    piece.input = std::move(box);
    return piece;
}

std::shared_ptr<const CellComplex>
withRings(const PeriodicPiece& piece, const FetchReach& reach)
{
    const SerialExchange exchange;
    const label nCells = piece.input.globalCells.size();
    WholeMesh whole;
    whole.bounds = boundBox(piece.input.points, false);
    whole.firstCells = labelList({0, nCells});
    whole.images = piece.images;
    CellComplexInput all(assemble(
        fetchRings(piece.input, piece.images.get(), exchange, reach),
        piece.input.patchNames, whole
    ));
    all.own.setSize(all.globalCells.size());
    forAll(all.own, celli)
    {
        all.own[celli] = all.globalCells[celli] < nCells;
    }
    return std::make_shared<const CellComplex>(std::move(all));
}

std::shared_ptr<FlowSnapshot> periodicSnapshot(
    std::shared_ptr<const CellComplex> complex, const Flow& flow, scalar time,
    const std::function<scalar(const point&)>& alpha
)
{
    const PeriodicImages& images = *complex->whole().images;
    const auto home = [&](label celli)
    {
        return complex->cellCentres(
        )[complex->localCell(images.realCell(complex->globalCell(celli)))];
    };
    auto snapshot = std::make_shared<FlowSnapshot>();
    snapshot->time = time;
    snapshot->alphas.setSize(1);
    snapshot->boundaryAlphas.setSize(1);
    for (label celli = 0; celli < complex->nCells(); ++celli)
    {
        const RigidMotion& motion = images.motion(complex->image(celli));
        snapshot->U.append(motion.turned(flow(home(celli), time)));
        snapshot->alphas[0].append(alpha(home(celli)));
    }
    for (label i = 0; i < complex->nBoundaryFaces(); ++i)
    {
        const label facei = complex->nInternalFaces() + i;
        const RigidMotion& motion =
            images.motion(complex->image(complex->owner()[facei]));
        const point x = motion.inverse()(complex->faceCentres()[facei]);
        snapshot->boundaryU.append(motion.turned(flow(x, time)));
        snapshot->boundaryAlphas[0].append(alpha(x));
    }
    snapshot->complex = std::move(complex);
    return snapshot;
}

} // namespace Foam::stability::shapes
