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
        shape          | sphere, plane or disc                 | yes  |
        centre         | of it; a point of the plane           | yes  |
        radius         | of sphere and disc [m]                | these only |
        normal         | of the plane                          | plane only  |
        axis           | of the body's rotation                | no | (0 0 1)
        through        | a point of that axis                  | no | (0 0 0)
        period         | of one revolution [s]; 0: none        | no | 0
        velocity       | of the body's translation [m/s]       | no | (0 0 0)
        copies         | shifts to further copies of it: those that cyclic
                         patches make [m]                     | no | ()
        sectors        | so many copies of it, about the axis | no | 1
        deformation    | of the unit cube, LeVeque's: period [s]; 0: none | no | 0
        velocityFactor | U is the body's own times this        | no | 1
        drift          | and faster along the normal by [m/s]  | no | 0
        strainAxis     | of the strain; the axis of a wedge    | wedge only | (1 0 0)
        strain         | along it, from \c through [1/s]; the sides approach it so
                         that no volume changes; for a disc    | no | 0
        phi            | are fluxes written? Those of U at the centres of faces
                                                               | no | no
    \endtable
    The body lies at \c centre at time 0 and is filled with water (alpha.water = 1);
    a plane is filled on the side that the normal leaves; its cells are boxes. A
    deformed sphere does not rotate, translate or drift. A disc is the
    section of a cylinder across layers of cells, between \c empty or symmetry planes or
    cyclic patches, or, on a wedge, of a body of revolution; one that is strained does
    not rotate or translate.
*/

#include "fvCFD.H"

#include "cyclicPolyPatch.H"
#include "emptyPolyPatch.H"
#include "symmetryPlanePolyPatch.H"
#include "wedgePolyPatch.H"

#include "shapes/DeformedSphere.H"
#include "shapes/DiscShare.H"
#include "shapes/PlaneVolume.H"
#include "shapes/SphereVolume.H"

#include <algorithm>

using namespace Foam::stability::shapes;

namespace
{

enum class Shape
{
    sphere,
    plane,
    disc
};

const Enum<Shape> shapeNames{
    {Shape::sphere, "sphere"}, {Shape::plane, "plane"}, {Shape::disc, "disc"}};

// The body and its rigid motion; Enum and dictionary end here.
class Body
{
public:
    Body(const dictionary& dict, const polyMesh& mesh)
        : shape_(shapeNames.get("shape", dict)), centre_(dict.get<point>("centre")),
          radius_(shape_ == Shape::plane ? 0 : dict.get<scalar>("radius")),
          normal_(shape_ == Shape::plane ? dict.get<vector>("normal") : vector::zero),
          axis_(normalised(dict.lookupOrDefault("axis", vector(0, 0, 1)))),
          through_(dict.lookupOrDefault("through", point::zero)),
          velocity_(dict.lookupOrDefault("velocity", vector::zero)),
          copies_(dict.lookupOrDefault("copies", List<vector>())),
          sectors_(dict.lookupOrDefault<label>("sectors", 1)),
          velocityFactor_(dict.lookupOrDefault<scalar>("velocityFactor", 1)),
          drift_(dict.lookupOrDefault<scalar>("drift", 0)),
          strainAxis_(normalised(dict.lookupOrDefault("strainAxis", vector(1, 0, 0)))),
          strain_(dict.lookupOrDefault<scalar>("strain", 0)), section_(sectionOf(mesh)),
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
        if (shape_ == Shape::disc)
        {
            return discFractions(mesh, time);
        }
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
        const vector away = shape_ == Shape::plane ? normal_ : normalised(x - at(time));
        return velocityFactor_ * (own + strainAt(x)) + drift_ * away;
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

    // What lies across the layers of cells, and the face of each cell on the low side.
    struct Section
    {
        bool wedge = false;
        vector normal{Zero};
        labelList ends;
    };

    static bool isEnd(const polyPatch& patch)
    {
        return isA<wedgePolyPatch>(patch) || isA<emptyPolyPatch>(patch)
               || isA<symmetryPlanePolyPatch>(patch);
    }

    // The axis across which the layers of cells lie is that of the last patch at their
    // ends, where there are none of the last cyclic patch.
    static Section sectionOf(const polyMesh& mesh)
    {
        Section section;
        const auto lieAcross = [&](const polyPatch& patch)
        {
            const vector size(cmptMag(patch.faceAreas()[0]));
            direction d = size.x() > size.y() ? 0 : 1;
            d = size.z() > size[d] ? 2 : d;
            section.normal = Zero;
            section.normal[d] = 1;
            section.wedge = section.wedge || isA<wedgePolyPatch>(patch);
        };
        for (const polyPatch& patch : mesh.boundaryMesh())
        {
            if (isA<cyclicPolyPatch>(patch) && !patch.empty())
            {
                lieAcross(patch);
            }
        }
        for (const polyPatch& patch : mesh.boundaryMesh())
        {
            if (isEnd(patch) && !patch.empty())
            {
                lieAcross(patch);
            }
        }
        section.ends = labelList(mesh.nCells(), -1);
        forAll(section.ends, celli)
        {
            scalar lowest = GREAT;
            for (const label facei : mesh.cells()[celli])
            {
                const vector& area = mesh.faceAreas()[facei];
                const scalar up = (area & section.normal) / mag(area)
                                  * (mesh.faceOwner()[facei] == celli ? 1 : -1);
                if (up < lowest)
                {
                    lowest = up;
                    section.ends[celli] = facei;
                }
            }
        }
        return section;
    }

    // A strained disc is the undeformed one, seen in the coordinates of the start.
    scalarField discFractions(const polyMesh& mesh, scalar time) const
    {
        const Section& section = section_;
        const vector side(section.normal ^ strainAxis_);
        const DynamicList<point> centres(centresAt(strain_ == 0 ? time : 0));
        const auto inPlane = [&](const point& x, scalar t)
        {
            const vector2D place((x - through_) & strainAxis_, (x - through_) & side);
            const scalar stretch = std::exp(-strain_ * t);
            const scalar across = section.wedge ? 1 / std::sqrt(stretch) : 1 / stretch;
            return vector2D(stretch * place.x(), across * place.y());
        };
        scalarField fractions(mesh.nCells(), 0);
        forAll(section.ends, celli)
        {
            List<vector2D> polygon;
            for (const label pointi : mesh.faces()[section.ends[celli]])
            {
                polygon.append(inPlane(mesh.points()[pointi], time));
            }
            const PlaneShare all(polygonShare(polygon));
            scalar share = 0;
            for (const point& centre : centres)
            {
                const PlaneShare disc(discShare(polygon, inPlane(centre, 0), radius_));
                share +=
                    section.wedge ? disc.moment / all.moment : disc.area / all.area;
            }
            fractions[celli] = Foam::max(0.0, Foam::min(1.0, share));
        }
        return fractions;
    }

    vector strainAt(const point& x) const
    {
        if (strain_ == 0)
        {
            return vector::zero;
        }
        const vector arm(x - through_);
        const vector along = (arm & strainAxis_) * strainAxis_;
        const vector across(arm - along);
        return strain_
               * (section_.wedge
                      ? along - 0.5 * across
                      : along - across + (across & section_.normal) * section_.normal);
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
    vector strainAxis_;
    scalar strain_; // [1/s]
    Section section_;
    scalar deformation_;      // [s]
    scalar angularSpeed_ = 0; // [rad/s]
};

void writeTime(const fvMesh& mesh, const Body& body, bool withPhi)
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
    if (withPhi)
    {
        surfaceScalarField phi(
            field("phi"), mesh, dimensionedScalar(dimVolume / dimTime, Zero)
        );
        phi.setOriented();
        const auto flux = [&](label facei) {
            return body.velocity(mesh.faceCentres()[facei], time)
                   & mesh.faceAreas()[facei];
        };
        forAll(phi, facei)
        {
            phi[facei] = flux(facei);
        }
        forAll(mesh.boundary(), patchi)
        {
            scalarField& values = phi.boundaryFieldRef()[patchi];
            forAll(values, i)
            {
                values[i] = flux(mesh.boundary()[patchi].start() + i);
            }
        }
        phi.write();
    }
}

} // namespace

int main(int argc, char* argv[])
{
    argList::addNote("Writes an exact moving body and its velocity at all times");
    argList::noParallel();

#include "setRootCase.H"
#include "createTime.H"

#include "createMesh.H"

    const IOdictionary dict(IOobject(
        "exactInterfaceDict", runTime.system(), mesh, IOobject::MUST_READ,
        IOobject::NO_WRITE
    ));
    const Body body(dict, mesh);
    const bool withPhi = dict.lookupOrDefault("phi", false);

    writeTime(mesh, body, withPhi);
    while (runTime.loop())
    {
        writeTime(mesh, body, withPhi);
    }
    Info << "Wrote " << runTime.timeIndex() + 1 << " times" << endl;
    return 0;
}
