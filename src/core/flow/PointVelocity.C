// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/PointVelocity.H"

#include "DynamicList.H"

namespace Foam::stability
{

namespace
{

// Wall faces that meet at less than this angle (45 degrees) are one bent wall: a
// particle slides around the bend. At a sharper edge it keeps to every face.
constexpr scalar sameWallCosine = 0.70710678118654752;

// Sine of the angle below which a normal adds nothing to those before it.
constexpr scalar dependentSine = 0.1;

// The mean of values at places around x, weighted with 1/distance as OpenFOAM's
// volPointInterpolation.
class DistanceMean
{
public:
    DistanceMean(const point& x, const WholeMesh& whole) : x_(x), whole_(whole) {}

    void add(const point& place, const vector& value)
    {
        const scalar distance = mag(whole_.inPlane(place - x_));
        const scalar weight = 1 / max(distance, VSMALL);
        weights_ += weight;
        sum_ += weight * value;
    }
    bool empty() const { return weights_ == 0; }
    vector value() const { return sum_ / weights_; }

private:
    point x_;
    const WholeMesh& whole_;
    scalar weights_ = 0;
    vector sum_{Zero};
};

// One smooth piece of wall around a point: area vector and velocity of the wall
// weighted with area.
struct WallPiece
{
    vector area{Zero};
    vector areaU{Zero};
    scalar areaSum = 0;

    vector normal() const { return area / max(mag(area), VSMALL); }
    vector U() const { return areaU / max(areaSum, VSMALL); }
};

using WallPieces = DynamicList<WallPiece, 4>;

void addWallFace(WallPieces& pieces, const vector& area, const vector& U)
{
    const scalar size = mag(area);
    label found = -1;
    forAll(pieces, i)
    {
        if ((pieces[i].normal() & area) > sameWallCosine * size)
        {
            found = i;
            break;
        }
    }
    if (found < 0)
    {
        found = pieces.size();
        pieces.append(WallPiece());
    }
    pieces[found].area += area;
    pieces[found].areaU += size * U;
    pieces[found].areaSum += size;
}

// The velocity next to U that runs along every piece of wall: U.n = U_wall.n for
// each of their normals, made orthonormal one after the other.
vector alongWalls(vector U, const WallPieces& pieces)
{
    FixedList<vector, 3> basis;
    label nBasis = 0;
    for (const WallPiece& piece : pieces)
    {
        const vector normal = piece.normal();
        vector direction = normal;
        for (label i = 0; i < nBasis; ++i)
        {
            direction -= (direction & basis[i]) * basis[i];
        }
        const scalar sine = mag(direction);
        if (sine < dependentSine || nBasis == 3)
        {
            continue;
        }
        direction /= sine;
        // Moving along `direction` leaves the conditions met so far as they are.
        U += ((piece.U() - U) & normal) / sine * direction;
        basis[nBasis++] = direction;
    }
    return U;
}

} // namespace

PointVelocity::PointVelocity(
    std::shared_ptr<const FlowSnapshot> snapshot, WallVelocity wallVelocity
)
    : snapshot_(std::move(snapshot)), wallVelocity_(wallVelocity),
      values_(snapshot_->complex->nPoints())
{
}

vector PointVelocity::compute(label pointi) const
{
    const CellComplex& complex = *snapshot_->complex;
    const point& x = complex.points()[pointi];

    DistanceMean open(x, complex.whole());
    DistanceMean wall(x, complex.whole());
    WallPieces pieces;
    for (const label facei : complex.pointBoundaryFaces()[pointi])
    {
        const label i = facei - complex.nInternalFaces();
        const BoundaryKind kind = complex.kinds()[i];
        const vector& U = snapshot_->boundaryU[i];
        const point& centre = complex.faceCentres()[facei];
        if (kind == BoundaryKind::open)
        {
            open.add(centre, U);
        }
        else if (kind == BoundaryKind::wall && wallVelocity_ == WallVelocity::noSlip)
        {
            wall.add(centre, U);
        }
        else
        {
            addWallFace(pieces, complex.faceAreas()[facei], U);
        }
    }

    if (!wall.empty())
    {
        return alongWalls(wall.value(), pieces);
    }
    if (pieces.empty() && !open.empty())
    {
        return open.value();
    }
    DistanceMean cells(x, complex.whole());
    for (const label celli : complex.pointCells()[pointi])
    {
        cells.add(complex.cellCentres()[celli], snapshot_->U[celli]);
    }
    return alongWalls(cells.value(), pieces);
}

} // namespace Foam::stability
