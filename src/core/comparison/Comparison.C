// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/comparison/Comparison.H"

#include "core/comparison/Inflow.H"
#include "core/ranks/ExactSum.H"
#include "core/surface/InterfaceMotion.H"
#include "core/surface/Ribbon.H"
#include "core/surface/pieces/SharedPoints.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

using Setting = Comparison::Setting;

// T's seams turn and end at places that are looked for on M within epsilon: what is
// farther than this from the corners of a triangle of cell size h has no say in how it
// is split [m].
scalar reachOfSplit(const MatchingOptions& matching, scalar h)
{
    return h + 2 * matching.epsilon.at(h);
}

// How far from any point of these there is what a search from it finds, or what has a
// say in what is found there; the same on all ranks [m].
scalar
searchReach(std::initializer_list<const SurfacePiece*> pieces, const Setting& setting)
{
    const MatchingOptions& matching = setting.matching;
    scalar reach = VSMALL;
    for (const SurfacePiece* piece : pieces)
    {
        for (const scalar h : piece->mesh.cellSizes)
        {
            reach = std::max(
                reach, std::max(reachOfSplit(matching, h), matching.searchRadius * h)
            );
        }
    }
    return largest(reach, setting.run.ranks);
}

// Adds the voxels nearer to a point of the piece than this distance [m] to the mask.
void addAround(const SurfacePiece& piece, scalar distance, VoxelMask& mask)
{
    for (const point& x : piece.mesh.points)
    {
        mask.add(x, distance);
    }
}

SurfaceHalo haloOf(const SurfacePiece& owned, const VoxelMask& mask, const Setting& s)
{
    return SurfaceHalo(owned, mask, s.run.ranks, s.whole().images.get());
}

VoxelMask voxelsFor(scalar reach)
{
    return VoxelMask(0.5 * reach);
}

// The halo of M: the triangles that searches from T's points and from M's may find.
SurfaceHalo interfaceHalo(
    const SurfacePiece& interface, const SurfacePiece& timeSurface, scalar reach,
    const Setting& setting
)
{
    VoxelMask mask(voxelsFor(reach));
    addAround(interface, reach, mask);
    addAround(timeSurface, reach, mask);
    return haloOf(interface, mask, setting);
}

// The halo of T: the triangles that searches from M's points and from T's may find, and
// those that are connected with them there.
SurfaceHalo timeSurfaceHalo(
    const SurfacePiece& interface, const SurfacePiece& timeSurface, scalar reach,
    const Setting& setting
)
{
    constexpr scalar connected = 1.7;
    VoxelMask mask(voxelsFor(reach));
    addAround(interface, connected * reach, mask);
    addAround(timeSurface, reach, mask);
    return haloOf(timeSurface, mask, setting);
}

// The own triangles of M and what has a say in how they are split.
SurfacePiece nearOwn(
    const SurfacePiece& owned, const SurfaceHalo& halo, const MatchingOptions& options,
    List<bool>& own
)
{
    scalar distance = VSMALL;
    for (const scalar h : owned.mesh.cellSizes)
    {
        distance = std::max(distance, reachOfSplit(options, h));
    }
    VoxelMask mask(voxelsFor(distance));
    addAround(owned, distance, mask);
    const InterfaceMesh& mesh = halo.mesh();
    DynamicList<label> triangles;
    DynamicList<bool> areOwn;
    forAll(mesh.triangles, trianglei)
    {
        const bool isOwn = halo.isOwn(trianglei);
        const triFace& t = mesh.triangles[trianglei];
        if (isOwn
            || (!owned.mesh.empty() && mask.meets(boundBox(mesh.points, t, false))))
        {
            triangles.append(trianglei);
            areOwn.append(isOwn);
        }
    }
    own = areOwn;
    return partOf(halo.piece(), triangles);
}

} // namespace

Comparison::Comparison(
    const Setting& setting, const SurfacePiece& interface,
    const TimeSurface& timeSurface
)
    : setting_(setting), owned_(timeSurface),
      reach_(searchReach({&interface, &timeSurface.piece()}, setting)),
      interface_(interfaceHalo(interface, timeSurface.piece(), reach_, setting)),
      timeSurface_(timeSurfaceHalo(interface, timeSurface.piece(), reach_, setting))
{
    runOnAllRanks(
        setting.run.ranks,
        [&] { near_ = nearOwn(interface, interface_, setting.matching, own_); }
    );
}

void Comparison::match()
{
    runOnAllRanks(
        setting_.run.ranks,
        [&]
        {
            const MatchingOptions& options = setting_.matching;
            const ThinWalls* walls = setting_.whole().thinWalls.get();
            target_.emplace(timeSurface_.mesh(), options, walls);
            onInterface_ = matchPoints(near_.mesh, *target_, options);
            onTimeSurface_ = matchPoints(
                timeSurface_.mesh(), MatchTarget(interface_.mesh(), options, walls),
                options, timeSurface_.owned()
            );
        }
    );
}

TransferResult Comparison::carryOver(const DistributedChart& chart)
{
    const Exchange& exchange = setting_.run.ranks;
    DynamicList<point> unmatched;
    forAll(onInterface_, pointi)
    {
        if (!onInterface_[pointi].stable)
        {
            unmatched.append(near_.mesh.points[pointi]);
        }
    }
    const TransferSurroundings around{
        chart.around(target_->mesh(), pointField(unmatched), exchange),
        seamShape(
            timeSurface_.piece(), target_->topology(), timeSurface_.ownTriangles(),
            exchange
        ),
        own_, setting_.section()};
    split_ = near_.mesh;
    useLocalCells(split_, setting_.complex());
    TransferResult result;
    runOnAllRanks(
        exchange,
        [&]
        {
            result =
                transfer(split_, onInterface_, *target_, setting_.transfer, around);
            settleInCells(split_, setting_.complex(), near_.mesh.points.size()); // new
        }
    );
    for (label* count :
         {&result.nCrossing, &result.nUnresolved, &result.nSplit, &result.nMerged})
    {
        *count = exchange.total(*count);
    }
    parents_ = result.parents;
    return result;
}

ClassifiedSurface Comparison::describeInterface(std::vector<Droplet>& droplets) const
{
    List<bool> nearWall(split_.points.size(), false);
    forAll(nearWall, pointi)
    {
        const label celli = split_.cells[pointi];
        nearWall[pointi] = celli >= 0 && setting_.complex().nearWall(celli);
    }
    ClassifiedSurface interface(stability::describe(
        split_, onInterface_, Stability::attached, nearWall, setting_.interval
    ));
    const List<bool> camePreviously(enteredBefore(owned_, timeSurface_));
    interface.fromOutside.setSize(nearWall.size(), false);
    forAll(nearWall, pointi)
    {
        const Match& match = onInterface_[pointi];
        interface.fromOutside[pointi] =
            match.stable && camePreviously[match.nearest.triangle];
    }
    InterfaceMesh mesh(split_);
    useGlobalCells(mesh, setting_.complex());
    JoinedSurface own(ownParts(mesh, parents_, near_, own_));
    const List<NamedPoint> shared(makeOnAllRanks(
        setting_.run.ranks,
        [&] { return sharedPoints(own, mesh, parents_, near_, own_); }
    ));
    agreeOnPoints(own.piece, shared, setting_.run.ranks);
    select(interface, own.pointSources);
    interface.order = own.piece;
    interface.mesh = own.piece.mesh;

    const SurfaceHalo halo(surroundings(own.piece, setting_));
    const std::optional<PlaneSection>& section = setting_.section();
    const Components components(
        halo, setting_.referencePoint(), setting_.run.ranks, section
    );
    interface.areas = halo.toOwned(pointAreasInMesh(halo.mesh(), section));
    interface.isPrimary = halo.toOwned(halo.primaryPoints());
    interface.components = halo.toOwned(components.ofPoints());
    SmallScales scales(
        smallScales(own.piece, halo, components, setting_.flow, setting_.run)
    );
    interface.thin = halo.toOwned(scales.thin);
    interface.subGrid = halo.toOwned(scales.subGrid);
    fillMarks(interface, interface.mesh.points.size());
    if (setting_.history && !setting_.history->empty())
    {
        const List<bool> mayEnter(
            mayHaveEntered(onInterface_, *target_, owned_.piece().sharesPoints)
        );
        findEntered(
            interface, halo, List<bool>(UList<bool>(mayEnter), own.pointSources),
            setting_
        );
    }
    droplets = std::move(scales.droplets);
    return interface;
}

ClassifiedSurface Comparison::describeTimeSurface() const
{
    return stability::describe(owned_, timeSurface_, onTimeSurface_, setting_);
}

SurfaceHalo surroundings(const SurfacePiece& owned, const Setting& setting)
{
    const scalar reach = searchReach({&owned}, setting);
    VoxelMask mask(voxelsFor(reach));
    addAround(owned, reach, mask);
    return haloOf(owned, mask, setting);
}

ClassifiedSurface describe(
    const TimeSurface& timeSurface, const SurfaceHalo& halo, const List<Match>& matches,
    const Setting& setting
)
{
    const PointMarks& marks = timeSurface.marks();
    ClassifiedSurface surface(describe(
        halo.mesh(), matches, Stability::detached, halo.toHalo(marks.nearWall),
        setting.interval
    ));
    forEachMark([&](const char*, const MarkFiles&, const auto& mark)
                { mark(surface) = halo.toHalo(mark(marks)); });
    Crossings& left = surface.crossings;
    left.crossed = halo.toHalo(timeSurface.left().crossed);
    left.ends = halo.toHalo(timeSurface.left().ends);
    left.beyond = halo.toHalo(timeSurface.left().beyond);
    // As they are now: what left lies flat on the boundary.
    surface.areas = pointAreas(
        halo.mesh(),
        halo.triangleValues(
            cornerShares(timeSurface.piece().mesh.triangles, timeSurface.left(), false)
        ),
        setting.section()
    );
    const List<PathlineState> states(halo.toHalo(timeSurface.states()));
    forAll(states, pointi)
    {
        Stability& stability = surface.stability[pointi];
        if (states[pointi] == PathlineState::left)
        {
            stability = Stability::left;
        }
        else if (states[pointi] != PathlineState::moving && stability == Stability::detached)
        {
            stability = Stability::untracked;
        }
    }
    surface.components =
        Components(halo, setting.referencePoint(), setting.run.ranks).ofPoints();
    return surface;
}

ClassifiedSurface toOwned(
    const ClassifiedSurface& onHalo, const SurfaceHalo& halo,
    const TimeSurface& timeSurface
)
{
    ClassifiedSurface surface(onHalo);
    select(surface, halo.places());
    surface.mesh = timeSurface.piece().mesh;
    surface.order = timeSurface.piece();
    return surface;
}

} // namespace Foam::stability
