// SPDX-License-Identifier: GPL-3.0-or-later

/*
Application
    exactInterface

Description
    Writes the volume fraction of an exact moving body and an analytic velocity, at
    every write time of the case's controlDict: data whose true answer is known.

Usage
    \b exactInterface [OPTIONS]

    Entries of system/exactInterfaceDict:
    \table
        Property       | Description                           | Required | Default
        shape          | sphere or plane                       | yes  |
        centre         | of the sphere, a point of the plane   | yes  |
        radius         | of the sphere [m]                     | sphere only |
        normal         | of the plane                          | plane only  |
        axis           | of the body's rotation                | no | (0 0 1)
        through        | a point of that axis                  | no | (0 0 0)
        period         | of one revolution [s]; 0: none        | no | 0
        velocity       | of the body's translation [m/s]       | no | (0 0 0)
        copies         | shifts to further copies of a sphere: those that cyclic
                         patches make [m]                     | no | ()
        sectors        | so many copies of it, about the axis | no | 1
        deformation    | of the unit cube, LeVeque's: period [s]; 0: none | no | 0
        velocityFactor | U is the body's own times this        | no | 1
        drift          | and faster along the normal by [m/s]  | no | 0
    \endtable
    The body lies at \c centre at time 0 and is filled with water (alpha.water = 1);
    a plane is filled on the side that the normal leaves; its cells are boxes. A
deformed sphere does not rotate, translate or drift.
*/

#include "fvCFD.H"

#include "shapes/DeformedSphere.H"
#include "shapes/PlaneVolume.H"
#include "shapes/SphereVolume.H"

#include <algorithm>

using namespace Foam::stability::shapes;

namespace
{

enum class Shape
{
    sphere,
    plane
};

const Enum<Shape> shapeNames{{Shape::sphere, "sphere"}, {Shape::plane, "plane"}};

// The body and its rigid motion; Enum and dictionary end here.
class Body
{
public:
    explicit Body(const dictionary& dict)
        : shape_(shapeNames.get("shape", dict)), centre_(dict.get<point>("centre")),
          radius_(shape_ == Shape::sphere ? dict.get<scalar>("radius") : 0),
          normal_(shape_ == Shape::plane ? dict.get<vector>("normal") : vector::zero),
          axis_(normalised(dict.lookupOrDefault("axis", vector(0, 0, 1)))),
          through_(dict.lookupOrDefault("through", point::zero)),
          velocity_(dict.lookupOrDefault("velocity", vector::zero)),
          copies_(dict.lookupOrDefault("copies", List<vector>())),
          sectors_(dict.lookupOrDefault<label>("sectors", 1)),
          velocityFactor_(dict.lookupOrDefault<scalar>("velocityFactor", 1)),
          drift_(dict.lookupOrDefault<scalar>("drift", 0)),
          deformation_(dict.lookupOrDefault<scalar>("deformation", 0))
    {
        const scalar period = dict.lookupOrDefault<scalar>("period", 0);
        angularSpeed_ = period > 0 ? constant::mathematical::twoPi / period : 0;
        if (shape_ == Shape::plane)
        {
            normal_.normalise();
        }
    }

    scalarField fractions(const polyMesh& mesh, scalar time) const
    {
        if (deformation_ > 0)
        {
            return DeformedSphere({centre_, radius_}, deformation_)
                .fractions(mesh.points(), mesh.cellPoints(), time);
        }
        if (shape_ == Shape::plane)
        {
            return planeFractions(mesh, at(time));
        }
        scalarField fractions(mesh.nCells(), 0);
        for (const point& centre : centresAt(time))
        {
            fractions += sphereFractions(mesh, {centre, radius_});
        }
        return fractions;
    }

    vector velocity(const point& x, scalar time) const
    {
        if (deformation_ > 0)
        {
            return velocityFactor_ * deformation(x, time, deformation_);
        }
        const vector own = velocity_ + angularSpeed_ * (axis_ ^ (x - through_));
        const vector away =
            shape_ == Shape::sphere ? normalised(x - at(time)) : normal_;
        return velocityFactor_ * own + drift_ * away;
    }

private:
    static vector normalised(vector v) { return v.normalise(); }

    static scalar max(const vector& v) { return cmptMax(v); }

    // Rodrigues.
    point turned(const point& x, scalar angle) const
    {
        const vector arm = x - through_;
        return through_ + std::cos(angle) * arm + std::sin(angle) * (axis_ ^ arm)
               + (1 - std::cos(angle)) * (axis_ & arm) * axis_;
    }

    // Rotated about the axis, then translated.
    point at(scalar time) const
    {
        return turned(centre_, angularSpeed_ * time) + time * velocity_;
    }

    // With the copies.
    DynamicList<point> centresAt(scalar time) const
    {
        DynamicList<point> centres;
        const point centre(at(time));
        for (label i = 0; i < sectors_; ++i)
        {
            const scalar angle = i * constant::mathematical::twoPi / sectors_;
            centres.append(i ? turned(centre, angle) : centre);
        }
        for (const vector& shift : copies_)
        {
            centres.append(centre + shift);
        }
        return centres;
    }

    static scalarField sphereFractions(const polyMesh& mesh, const Ball& ball)
    {
        scalarField volumes(mesh.nCells(), 0);
        forAll(mesh.faces(), facei)
        {
            const pointField polygon(mesh.faces()[facei].points(mesh.points()));
            const scalar flux = faceFlux(polygon, ball);
            volumes[mesh.faceOwner()[facei]] += flux;
            if (mesh.isInternalFace(facei))
            {
                volumes[mesh.faceNeighbour()[facei]] -= flux;
            }
        }
        const label holder = mesh.findCell(ball.centre);
        if (holder >= 0)
        {
            volumes[holder] += ball.volume();
        }
        return Foam::max(0.0, Foam::min(1.0, volumes / mesh.cellVolumes()));
    }

    // Volume fractions of cells that are axis-aligned boxes.
    scalarField planeFractions(const polyMesh& mesh, const point& on) const
    {
        scalarField fractions(mesh.nCells());
        forAll(fractions, celli)
        {
            const boundBox box(mesh.points(), mesh.cellPoints()[celli], false);
            fractions[celli] = boxShareBehind(
                normal_ & (box.centre() - on), cmptMultiply(normal_, box.span())
            );
        }
        return fractions;
    }

    Shape shape_;
    point centre_;
    scalar radius_;
    vector normal_;
    vector axis_;
    point through_;
    vector velocity_;
    List<vector> copies_;
    label sectors_;
    scalar velocityFactor_;
    scalar drift_;
    scalar deformation_;      // [s]
    scalar angularSpeed_ = 0; // [rad/s]
};

void writeTime(const fvMesh& mesh, const Body& body)
{
    const scalar time = mesh.time().value();
    const auto field = [&mesh](const word& name)
    { return IOobject(name, mesh.time().timeName(), mesh); };

    volScalarField alpha(
        field("alpha.water"), mesh, dimensionedScalar(dimless, Zero),
        calculatedFvPatchScalarField::typeName
    );
    alpha.primitiveFieldRef() = body.fractions(mesh, time);
    volVectorField U(
        field("U"), mesh, dimensionedVector(dimVelocity, Zero),
        calculatedFvPatchVectorField::typeName
    );
    forAll(U, celli)
    {
        U[celli] = body.velocity(mesh.C()[celli], time);
    }
    forAll(mesh.boundary(), patchi)
    {
        const fvPatch& patch = mesh.boundary()[patchi];
        alpha.boundaryFieldRef()[patchi] =
            alpha.boundaryField()[patchi].patchInternalField();
        forAll(patch, i)
        {
            U.boundaryFieldRef()[patchi][i] = body.velocity(patch.Cf()[i], time);
        }
    }
    alpha.write();
    U.write();
}

} // namespace

int main(int argc, char* argv[])
{
    argList::addNote("Writes an exact moving body and its velocity at all times");
    argList::noParallel();

#include "setRootCase.H"
#include "createTime.H"

#include "createMesh.H"

    const Body body(IOdictionary(IOobject(
        "exactInterfaceDict", runTime.system(), mesh, IOobject::MUST_READ,
        IOobject::NO_WRITE
    )));

    writeTime(mesh, body);
    while (runTime.loop())
    {
        writeTime(mesh, body);
    }
    Info << "Wrote " << runTime.timeIndex() + 1 << " times" << endl;
    return 0;
}
