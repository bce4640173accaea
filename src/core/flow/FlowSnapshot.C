// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/FlowSnapshot.H"

#include "core/base/Errors.H"

#include <cmath>
#include <sstream>
#include <string>

namespace Foam::stability
{

namespace
{

constexpr scalar lowestAlpha = -0.1;
constexpr scalar highestAlpha = 1.1;
constexpr scalar largestSpeed = 1e8; // [m/s]; beyond it numbers overflow, not fluids

void checkSize(const std::string& name, label size, label wanted)
{
    if (size != wanted)
    {
        throw BadInput(
            name + " has " + std::to_string(size) + " values, the mesh has "
            + std::to_string(wanted) + "."
        );
    }
}

void checkAlpha(
    const std::string& name, const scalarField& values, const UList<point>& places
)
{
    checkSize(name, values.size(), places.size());
    forAll(values, i)
    {
        const scalar value = values[i];
        if (!std::isfinite(value))
        {
            throw BadInput(name + " is not finite at " + textOf(places[i]) + ".");
        }
        if (value < lowestAlpha || value > highestAlpha)
        {
            throw BadInput(
                name + " is " + std::to_string(value) + " at " + textOf(places[i])
                + "; allowed is 0 to 1, by 0.1 more or less."
            );
        }
    }
}

void checkVelocity(
    const std::string& name, const vectorField& values, const UList<point>& places
)
{
    checkSize(name, values.size(), places.size());
    forAll(values, i)
    {
        const vector& U = values[i];
        const scalar speed = cmptMax(cmptMag(U)); // its square could overflow
        if (!std::isfinite(U.x()) || !std::isfinite(U.y()) || !std::isfinite(U.z()))
        {
            throw BadInput(name + " is not finite at " + textOf(places[i]) + ".");
        }
        if (!(speed <= largestSpeed))
        {
            std::ostringstream found;
            found << name << " is " << speed << " m/s at " << textOf(places[i])
                  << "; allowed is up to " << largestSpeed << ".";
            throw BadInput(found.str());
        }
    }
}

} // namespace

void FlowSnapshot::check() const
{
    const pointField& cells = complex->cellCentres();
    const SubList<point> boundary(
        complex->faceCentres(), complex->nBoundaryFaces(), complex->nInternalFaces()
    );
    if (alphas.empty() || alphas.size() != boundaryAlphas.size())
    {
        throw BadInput(
            "A snapshot needs a volume fraction in cells and on the boundary."
        );
    }
    forAll(alphas, i)
    {
        checkAlpha("The volume fraction in the cells", alphas[i], cells);
        checkAlpha("The volume fraction on the boundary", boundaryAlphas[i], boundary);
    }
    checkVelocity("The velocity in the cells", U, cells);
    checkVelocity("The velocity on the boundary", boundaryU, boundary);
}

} // namespace Foam::stability
