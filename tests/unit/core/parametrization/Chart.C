// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/Chart.H"

#include "core/base/Errors.H"
#include "core/parametrization/ChartDistortion.H"
#include "core/parametrization/Remeshing.H"
#include "shapes/ChartOverlap.H"
#include "shapes/RaggedSurface.H"
#include "shapes/Surfaces.H"
#include "DynamicList.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;
using namespace Foam::stability::shapes;

namespace
{

List<triFace> trianglesOf(const Chart& chart)
{
    List<triFace> triangles(chart.corners.size());
    forAll(triangles, i)
    {
        const CornerIndices& c = chart.corners[i];
        triangles[i] = triFace(c[0], c[1], c[2]);
    }
    return triangles;
}

void expectOneToOne(const PlainSurface& surface, const Chart& chart)
{
    ASSERT_EQ(chart.corners.size(), surface.triangles.size());
    const List<triFace> triangles = trianglesOf(chart);
    EXPECT_TRUE(shapeOf(chart.parameters.size(), triangles).isDisk());
    EXPECT_EQ(countFlips(chart.parameters, triangles), 0);
    EXPECT_EQ(countOverlaps(chart.parameters, triangles), 0);

    scalar onSurface = 0, inChart = 0;
    forAll(triangles, i)
    {
        const List<vector2D>& p = chart.parameters;
        const triFace& t = triangles[i];
        onSurface += surface.triangles[i].mag(chart.points);
        inChart += 0.5 * (p[t[1]] - p[t[0]]).perp(p[t[2]] - p[t[0]]);
    }
    EXPECT_NEAR(inChart / onSurface, 1, 1e-9);
}

PlainSurface longEllipsoid()
{
    PlainSurface surface = sphere(point(0, 0, 0), 1, 3);
    for (point& p : surface.points)
    {
        p = point(3.7 * p.x(), 0.8 * p.y(), p.z());
    }
    return surface;
}

// A method that never works, or folds the chart over.
class Useless : public Flattening
{
public:
    explicit Useless(bool folds) : folds_(folds) {}

    FlatteningResult flatten(const PlainSurface& surface) const override
    {
        if (!folds_)
        {
            throw NumericalFailure("Useless.");
        }
        FlatteningResult result = Flattening::New("tutte")->flatten(surface);
        List<vector2D>& chart = result.parameters;
        for (vector2D& p : chart)
        {
            p.x() = mag(p.x() - chart[0].x());
        }
        return result;
    }

private:
    bool folds_;
};

} // namespace

// The rounded corner of a box is a disk: flattened as it is it is distorted, cut to the
// corner almost not at all.
TEST(Chart, CutsToTheCornerOfABox)
{
    const boundBox box(point(-1, -1, -1), point(1, 1, 1));
    const auto level = [](const point& p)
    { return max(max(p.x() - .013, p.y() + .021), p.z() - .007); };
    const PlainSurface surface =
        remesh(marchingTetrahedra(level, box, 20), 0.05).surface;
    ASSERT_TRUE(shapeOf(surface.points.size(), surface.triangles).isDisk());
    const Chart chart = makeChart(surface, flatteningsFor("abf"));
    EXPECT_EQ(chart.method, "abf");
    expectOneToOne(surface, chart);
    EXPECT_LT(chart.areaRatio, 2);
    const List<vector2D> whole = Flattening::New("abf")->flatten(surface).parameters;
    List<CornerIndices> corners(surface.triangles.size());
    forAll(corners, i)
    {
        const triFace& t = surface.triangles[i];
        corners[i] = CornerIndices{t[0], t[1], t[2]};
    }
    EXPECT_GT(areaRatioOf(surface, corners, whole), 6);
}

TEST(Chart, IsOneToOneForEveryTopology)
{
    for (const char* name : {"abf", "lscm"})
    {
        for (const PlainSurface& surface :
             {sphere(point(1, 2, 3), 0.01, 3), torus(1, 0.4, 48, 24),
              hemisphere(point(0, 0, 0), 1, 3), columns({"XXXXX", "X X X", "XXXXX"}),
              longEllipsoid()})
        {
            const Chart chart = makeChart(surface, flatteningsFor(name));
            EXPECT_FALSE(chart.fallback);
            EXPECT_EQ(chart.method, name);
            expectOneToOne(surface, chart);
            EXPECT_GE(chart.areaRatio, 1);
        }
    }
}

// A ring that is flat or almost flat lies flat with its hole; opened along a cut it
// would touch itself. A tube is better off cut.
TEST(Chart, RingsNeedNoCut)
{
    const auto lscm = flatteningsFor("lscm");
    for (const scalar waves : {0.0, 0.1})
    {
        PlainSurface ring = annulus(0.5, 1, 48, 8);
        for (point& p : ring.points)
        {
            p.z() += waves * std::sin(5 * p.x() + 3 * p.y());
        }
        const Chart chart = makeChart(ring, lscm);
        EXPECT_FALSE(chart.fallback);
        EXPECT_EQ(chart.parameters.size(), ring.points.size());
        const List<triFace> triangles = trianglesOf(chart);
        EXPECT_EQ(countFlips(chart.parameters, triangles), 0);
        EXPECT_EQ(countOverlaps(chart.parameters, triangles), 0);
        EXPECT_LT(chart.areaRatio, waves > 0 ? 3 : 1 + 1e-9);
    }
    const PlainSurface tube = grid(
        [](scalar u, scalar v)
        { return point(std::cos(2 * M_PI * u), std::sin(2 * M_PI * u), 3 * v); },
        24, 12, true
    );
    const Chart chart = makeChart(tube, lscm);
    EXPECT_FALSE(chart.fallback);
    EXPECT_GT(chart.parameters.size(), tube.points.size());
    expectOneToOne(tube, chart);
    EXPECT_LT(chart.areaRatio, 1.1);
}

// In the smallest rectangle: that of the developed cylinder.
TEST(Chart, IsTurnedUpright)
{
    const scalar radius = 0.5, height = 3;
    const PlainSurface surface = openCylinder(radius, height, 270, 96, 24);
    const Chart chart = makeChart(surface, flatteningsFor("lscm"));
    vector2D low = chart.parameters[0], high = low;
    for (const vector2D& p : chart.parameters)
    {
        low = min(low, p);
        high = max(high, p);
    }
    const vector2D size = high - low;
    // The chords of 96 pieces of the arc.
    const scalar arc = 96 * 2 * radius * std::sin(0.5 * 1.5 * M_PI / 96);
    EXPECT_NEAR(min(size.x(), size.y()) / arc, 1, 1e-8);
    EXPECT_NEAR(max(size.x(), size.y()) / height, 1, 1e-8);
    EXPECT_NEAR(chart.areaRatio, 1, 1e-7);
}

// A long closed finger is a disk, but its tip would shrink to nothing: it is cut
// further.
TEST(Chart, CutsFurtherWhereTheChartShrinks)
{
    const label nAround = 16;
    PlainSurface finger = grid(
        [](scalar u, scalar v)
        {
            const scalar r = 0.1 * min(1.0, 4 * (1 - v)), z = 3 * v;
            return point(r * std::cos(2 * M_PI * u), r * std::sin(2 * M_PI * u), z);
        },
        nAround, 60, true
    );
    // Weld the last row, which is the tip.
    const label tip = finger.points.size() - 1;
    DynamicList<triFace> triangles;
    for (triFace t : finger.triangles)
    {
        for (label& i : t)
        {
            i = finger.points[i].z() > 2.999 ? tip : i;
        }
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
        {
            triangles.append(t);
        }
    }
    finger.triangles = triangles;
    ASSERT_EQ(DiskCut(finger).seams().size(), 0);

    const Chart chart = makeChart(finger, flatteningsFor("lscm"));
    EXPECT_FALSE(chart.fallback);
    EXPECT_LT(chart.areaRatio, 100);
    expectOneToOne(finger, chart);
}

TEST(Chart, FallsBack)
{
    const PlainSurface surface = hemisphere(point(0, 0, 0), 1, 3);
    for (const bool folds : {false, true})
    {
        const auto useless = std::make_shared<Useless>(folds);
        const Chart chart = makeChart(
            surface, {{"one", useless},
                      {"two", useless},
                      {"tutte", Flattening::New("tutte")},
                      {"lscm", Flattening::New("lscm")}}
        );
        EXPECT_TRUE(chart.fallback);
        EXPECT_EQ(chart.method, "tutte");
        const std::string why =
            folds ? "its triangles overlap in the plane" : "Useless.";
        EXPECT_EQ(chart.failure, "one failed (" + why + "); two failed (" + why + ")");
        expectOneToOne(surface, chart);
        // On the shortest cut: none at all.
        EXPECT_EQ(chart.parameters.size(), surface.points.size());
    }
}

TEST(Chart, IsEmptyWhereNothingHelps)
{
    PlainSurface flat = openCylinder(1, 1, 90, 4, 2);
    for (point& p : flat.points)
    {
        p = point(1, 2, 3);
    }
    const Chart chart = makeChart(flat, flatteningsFor("lscm"));
    EXPECT_TRUE(chart.fallback);
    EXPECT_TRUE(chart.parameters.empty());
}

// LSCM needs triangles that have edges and areas; Tutte's method needs neither.
TEST(Chart, fallsBackWhereATriangleIsFlat)
{
    PlainSurface surface = openCylinder(1, 1, 90, 4, 2);
    const triFace t = surface.triangles[5];
    surface.points[t[1]] = surface.points[t[0]];
    const Chart chart = makeChart(surface, flatteningsFor("lscm"));
    EXPECT_TRUE(chart.fallback);
    EXPECT_FALSE(chart.failure.empty());
    ASSERT_FALSE(chart.parameters.empty());
    expectOneToOne(surface, chart);
}
