// SPDX-License-Identifier: GPL-3.0-or-later

// The start of StabilityTracker: how the first interface gets p.

#include "core/StabilityTracker.H"

#include "core/base/ScopedTimer.H"
#include "core/surface/Ribbon.H"

namespace Foam::stability
{

// Step 1 of the method (paper 4.2): the first interface there is is flattened, and T is
// its remeshed copy, from which it gets p.
void StabilityTracker::startSurface(const SurfacePiece& interface)
{
    enter(Phase::parametrization);
    const ScopedTimer watch(timings_.parametrization);
    const Comparison::Setting setting(this->setting());
    {
        const Components components(
            surroundings(interface, setting), setting.referencePoint(), exchange_,
            setting.section()
        );
        const List<bool> all(interface.mesh.triangles.size(), true);
        result_.parametrization = parametrize(
            wholeComponents(interface, components, all, exchange_).piece,
            options_.parametrization, exchange_, setting.section()
        );
    }
    SurfacePiece& surface = result_.parametrization->surface;
    surface = join({surface}).piece; // points in the order of triangles
    PointMarks marks;
    marks.areas = pointAreasInMesh(surface.mesh, setting.section());
    marks.isPrimary = List<bool>(surface.mesh.points.size(), true);
    timeSurface_.seedRemeshed(surface, marks, latest_->time, complex(), exchange_);
    surface = timeSurface_.piece();
    chart_ = DistributedChart(surface, complex().whole(), exchange_);

    const SurfaceHalo halo(surroundings(surface, setting));
    const SmallScales scales(smallScales(
        surface, halo,
        Components(halo, setting.referencePoint(), exchange_, setting.section()),
        latest_, setting.run
    ));
    timeSurface_.setSmallScales(
        halo.toOwned(scales.thin), halo.toOwned(scales.subGrid)
    );
    parametrized_ = true;
}

// M lies off its remeshed copy T by a distance that is known, however narrow the band.
Comparison::Setting StabilityTracker::settingOfCopy() const
{
    constexpr scalar reserve = 2; // for points that seams add
    Comparison::Setting result(setting());
    result.matching.epsilon.least =
        reserve * result_.parametrization->remeshingDistance;
    result.matching.normalGate = false; // remeshing rounds corners off
    result.transfer.merge = Merge::nearest;
    return result;
}

// The first interface appeared just now: all of it is attached, or entered. Its
// flattened copy is written in T's place, and the next T starts from M with the copy's
// p.
ClassifiedSurface StabilityTracker::appearedInterface(const SurfacePiece& interface)
{
    startSurface(interface);
    const SurfaceHalo halo(surroundings(timeSurface_.piece(), setting()));
    List<Match> atHome(halo.mesh().points.size());
    for (Match& match : atHome)
    {
        match.stable = true;
        match.nPreimages = 1;
        match.nearest.distance = 0;
    }
    result_.timeSurface =
        toOwned(describe(timeSurface_, halo, atHome, setting()), halo, timeSurface_);

    Comparison comparison(settingOfCopy(), interface, timeSurface_);
    comparison.match();
    comparison.carryOver(chart_);
    std::vector<Droplet> known;
    return comparison.describeInterface(known);
}

} // namespace Foam::stability
