// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/PeriodicImages.H"

#include "core/base/Errors.H"
#include "tensor.H"

#include <gtest/gtest.h>

#include <cmath>

namespace Foam::stability
{

namespace
{

const boundBox box(point(0, 0, 0), point(2, 3, 4));

RigidMotion shiftBy(const vector& way)
{
    RigidMotion motion;
    motion.shift = way;
    return motion;
}

// About an axis along z.
RigidMotion turnBy(scalar angle, const point& through)
{
    RigidMotion motion;
    const scalar c = std::cos(angle), s = std::sin(angle);
    motion.rotation = tensor(c, -s, 0, s, c, 0, 0, 0, 1);
    motion.shift = through - (motion.rotation & through);
    return motion;
}

constexpr label nCells = 100, nPoints = 150;

} // namespace

TEST(PeriodicImages, motionsFollowEachOther)
{
    const PeriodicImages images(
        {shiftBy(vector(2, 0, 0)), shiftBy(vector(0, -3, 0))}, box, nCells, nPoints
    );
    const label right = images.indexOf(shiftBy(vector(2, 0, 0)));
    const label up = images.indexOf(shiftBy(vector(0, 3, 0)));
    EXPECT_GT(right, 0);
    EXPECT_GT(up, 0);
    const label both = images.product(right, up);
    EXPECT_EQ(both, images.product(up, right));
    EXPECT_LT(mag(images.motion(both).shift - vector(2, 3, 0)), 1e-14);
    EXPECT_EQ(images.product(both, images.inverse(right)), up);
    EXPECT_EQ(images.product(both, images.inverse(both)), 0);
}

// Ranks come upon the motions in different orders.
TEST(PeriodicImages, numbersDoNotDependOnTheQuestions)
{
    const std::vector<RigidMotion> generators{
        shiftBy(vector(2, 0, 0)), shiftBy(vector(0, 3, 0)), shiftBy(vector(0, 0, 4))};
    const PeriodicImages near(generators, box, nCells, nPoints);
    const PeriodicImages far(generators, box, nCells, nPoints);
    const RigidMotion next(shiftBy(vector(-2, 0, 0)));
    const RigidMotion distant(shiftBy(vector(4, -3, 8)));
    const label nextFirst = near.indexOf(next);
    const label distantFirst = far.indexOf(distant);
    EXPECT_EQ(near.indexOf(distant), distantFirst);
    EXPECT_EQ(far.indexOf(next), nextFirst);
    EXPECT_GT(distantFirst, nextFirst);
}

TEST(PeriodicImages, theSectorsOfACircleClose)
{
    const point through(0.3, 0.2, 0);
    const PeriodicImages images({turnBy(-M_PI / 3, through)}, box, nCells, nPoints);
    label image = 0;
    const label sector = images.indexOf(turnBy(M_PI / 3, through));
    for (label n = 1; n <= 6; ++n)
    {
        image = images.product(sector, image);
        EXPECT_EQ(image == 0, n == 6);
    }
    // On the axis all images of a point are one.
    const point onAxis(through + vector(0, 0, 1.7)),
        beside(through + vector(0, 0.1, 1));
    EXPECT_EQ(images.point(7, onAxis, sector), 7);
    EXPECT_EQ(images.equals(sector, onAxis).size(), 6);
    EXPECT_GT(images.point(7, beside, sector), nPoints);
    EXPECT_EQ(images.equals(sector, beside).size(), 1);
}

TEST(PeriodicImages, numbersOfCellsAndPoints)
{
    const PeriodicImages images({shiftBy(vector(2, 0, 0))}, box, nCells, nPoints);
    const label right = images.indexOf(shiftBy(vector(2, 0, 0)));
    const label left = images.inverse(right);
    const label cell = images.cell(42, right);
    EXPECT_EQ(images.realCell(cell), 42);
    EXPECT_EQ(images.imageOfCell(cell), right);
    EXPECT_EQ(images.movedCell(cell, left), 42);
    const point home(0, 1, 1);
    const label pointi = images.point(11, home, images.imageAt(point(2, 1, 1), home));
    EXPECT_EQ(images.imageOfPoint(pointi), right);
    EXPECT_EQ(images.place(pointi, home), point(2, 1, 1));
    EXPECT_EQ(images.movedPoint(pointi, home, left), 11);
    EXPECT_THROW(images.imageAt(point(2, 1.2, 1), home), BadInput);
}

// Halves of a baffle that are at one place: what is behind is the mesh itself.
TEST(PeriodicImages, aPairAtOnePlaceHasNoImages)
{
    const PeriodicImages images({shiftBy(vector(1e-13, 0, 0))}, box, nCells, nPoints);
    EXPECT_EQ(images.indexOf(shiftBy(vector(0, 1e-13, 0))), 0);
    EXPECT_THROW(images.indexOf(shiftBy(vector(1, 0, 0))), BadInput);
}

TEST(PeriodicImages, labelsThatAreTooShort)
{
    const PeriodicImages images({shiftBy(vector(2, 0, 0))}, box, labelMax / 2, nPoints);
    EXPECT_NO_THROW(images.cell(labelMax / 2 - 1, 1));
    EXPECT_THROW(images.cell(2, 2), BadInput);
}

// Of a cell and its images one is chosen, the same where all are moved alike.
TEST(PeriodicImages, theRepresentativeMovesAlong)
{
    const PeriodicImages images(
        {shiftBy(vector(2, 0, 0)), shiftBy(vector(0, 3, 0))}, box, nCells, nPoints
    );
    const labelList some{
        0, images.indexOf(shiftBy(vector(2, 0, 0))),
        images.indexOf(shiftBy(vector(2, 3, 0)))};
    const label chosen = images.representative(some);
    for (label by = 0; by < images.nNearby(); ++by)
    {
        labelList moved(some.size());
        forAll(some, i)
        {
            moved[some.size() - 1 - i] = images.product(by, some[i]);
        }
        EXPECT_EQ(images.representative(moved), images.product(by, chosen)) << by;
    }
}

// Its divergence is 1, and motions map it onto itself.
TEST(PeriodicImages, invariantFields)
{
    const RigidMotion along = shiftBy(vector(0, 0, 4));
    const RigidMotion turn = turnBy(M_PI / 3, point(0.3, 0.2, 0));
    const RigidMotion halfTurn = turnBy(M_PI, point(0.3, 0.2, 0));
    const std::vector<std::vector<RigidMotion>> all{
        {along},    {along, shiftBy(vector(1, 3, 0))},
        {turn},     {turn, along},
        {halfTurn}, {turn * along}};
    for (const std::vector<RigidMotion>& generators : all)
    {
        const PeriodicImages images(generators, box, nCells, nPoints);
        const auto field = images.invariantField();
        ASSERT_TRUE(field);
        EXPECT_NEAR(tr(field->A), 1, 1e-12);
        const point x(0.7, -1.1, 2.3);
        for (const RigidMotion& motion : generators)
        {
            EXPECT_LT(mag((*field)(motion(x)) - motion.turned((*field)(x))), 1e-12);
        }
    }
    const PeriodicImages everywhere(
        {shiftBy(vector(2, 0, 0)), shiftBy(vector(0, 3, 0)), along}, box, nCells,
        nPoints
    );
    EXPECT_FALSE(everywhere.invariantField());
}

} // namespace Foam::stability
