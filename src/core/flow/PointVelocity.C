// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/PointVelocity.H"

#include "DynamicList.H"

#include <vector>

namespace Foam::stability
{

namespace
{

// Wall faces that meet at less than this angle (45 degrees) are one bent wall: a
// particle slides around the bend. At a sharper edge it keeps to every face.
constexpr scalar sameWallCosine = 0.70710678118654752;

// Sine of the angle below which a normal adds nothing to those before it.
constexpr scalar dependentSine = 0.1;

// Two pieces of wall form a ridge if neither lies clearly inside the other's plane: the
// sine of half the angle that makes a wall bent.
constexpr scalar besideSine = 0.38268343236508978;

// A velocity that points into a wall by less than this share of its size does not.
constexpr scalar intoWall = 1e-9;

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

// One smooth piece of wall around a point: area vector, and velocity of the wall and
// way from the point to the piece weighted with area.
struct WallPiece
{
    vector area{Zero};
    vector areaU{Zero};
    vector areaArm{Zero};
    scalar areaSum = 0;

    vector normal() const { return area / max(mag(area), VSMALL); }
    vector U() const { return areaU / max(areaSum, VSMALL); }
    vector direction() const { return areaArm / max(mag(areaArm), VSMALL); }

    // True where this velocity points into the piece.
    bool stops(const vector& velocity) const
    {
        const vector relative = velocity - U();
        return (relative & normal()) > intoWall * mag(relative);
    }
};

using WallPieces = DynamicList<WallPiece, 4>;

void addWallFace(
    WallPieces& pieces, const vector& area, const vector& U, const vector& arm
)
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
    pieces[found].areaArm += size * arm;
    pieces[found].areaSum += size;
}

// The velocity next to U that runs along every piece of wall: U.n = U_wall.n for
// each of their normals, made orthonormal one after the other.
vector alongAll(vector U, const UList<WallPiece>& pieces)
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

// True at a convex edge of an obstacle, and at the rim of a thin wall: the fluid lies
// beyond the plane of each of the two pieces.
bool formRidge(const WallPiece& a, const WallPiece& b)
{
    return (a.direction() & b.normal()) > -besideSine
           && (b.direction() & a.normal()) > -besideSine;
}

// The velocity at a point with ridges, next to U: along the pieces that are in no
// ridge, and at a ridge into no piece, unless it points out of the other one, past
// which the fluid goes on.
class VelocityAtRidges
{
public:
    VelocityAtRidges(const vector& U, const WallPieces& pieces)
        : U_(U), pieces_(pieces), partners_(pieces.size())
    {
        forAll(pieces, i)
        {
            forAll(pieces, j)
            {
                if (i != j && formRidge(pieces[i], pieces[j]))
                {
                    partners_[i].append(j);
                }
            }
            if (partners_[i].empty())
            {
                along_.append(pieces[i]);
            }
        }
    }

    vector nearest()
    {
        if (along_.size() < pieces_.size())
        {
            search(0, 0);
        }
        return found_ ? nearest_ : alongAll(U_, pieces_);
    }

private:
    bool isAdmissible(const vector& velocity) const
    {
        forAll(pieces_, i)
        {
            bool stopped = !partners_[i].empty() && pieces_[i].stops(velocity);
            for (const label j : partners_[i])
            {
                stopped = stopped && pieces_[j].stops(velocity);
            }
            if (stopped)
            {
                return false;
            }
        }
        return true;
    }

    // Tries the velocities along up to three pieces of ridges, from piece `first` on.
    void search(label first, label nAlong)
    {
        const vector velocity = alongAll(U_, along_);
        const scalar change = magSqr(velocity - U_);
        if ((!found_ || change < change_) && isAdmissible(velocity))
        {
            found_ = true;
            nearest_ = velocity;
            change_ = change;
        }
        for (label i = first; nAlong < 3 && i < pieces_.size(); ++i)
        {
            if (!partners_[i].empty())
            {
                along_.append(pieces_[i]);
                search(i + 1, nAlong + 1);
                along_.remove();
            }
        }
    }

    vector U_;
    const WallPieces& pieces_;
    std::vector<DynamicList<label>> partners_; // those that form a ridge with the piece
    WallPieces along_;
    bool found_ = false;
    vector nearest_{Zero};
    scalar change_ = 0; // from U to nearest_, squared
};

vector alongWalls(const vector& U, const WallPieces& pieces)
{
    return VelocityAtRidges(U, pieces).nearest();
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
            addWallFace(pieces, complex.faceAreas()[facei], U, centre - x);
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
