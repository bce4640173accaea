// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/ReconstructionErrors.H"
#include "shapes/BoxMesh.H"
#include "shapes/ExactAlpha.H"
#include "mathematicalConstants.H"

#include <cmath>
#include <random>

namespace Foam::stability::shapes
{

namespace
{

using constant::mathematical::pi;

// In [-1/2, 1/2), the same on every machine.
scalar uniform(std::mt19937& generator)
{
    return generator() / 4294967296.0 - 0.5;
}

vector uniformVector(std::mt19937& generator)
{
    const scalar x = uniform(generator);
    const scalar y = uniform(generator);
    return vector(x, y, uniform(generator));
}

} // namespace

BallErrors ballErrors(const Reconstruction& method, label nSamples)
{
    const label n = 24;
    const scalar h = 1.0 / n;
    const scalar radius = 9.6 * h;
    const auto complex = unitCube(n);
    std::mt19937 generator(11);
    BallErrors errors;
    scalar squares = 0;
    label nPoints = 0;
    for (label sample = 0; sample < nSamples; ++sample)
    {
        const point centre = point(0.5, 0.5, 0.5) + h * uniformVector(generator);
        const Shape ball = sphere(centre, radius);
        const auto result = method.extract(snapshotOf(complex, ball));
        errors.meanVolume += result.volumeError() / nSamples;
        const scalar area = result.mesh.area() / (4 * pi * sqr(radius));
        errors.meanArea += (area - 1) / nSamples;
        for (const point& x : result.mesh.points)
        {
            const scalar distance = mag(ball(x)) / h;
            errors.largestDistance = max(errors.largestDistance, distance);
            squares += sqr(distance);
        }
        nPoints += result.mesh.points.size();
    }
    errors.rmsDistance = std::sqrt(squares / max(nPoints, label(1)));
    return errors;
}

scalar planeError(const Reconstruction& method)
{
    const label n = 10;
    const scalar h = 1.0 / n;
    const auto complex = unitCube(n);
    std::mt19937 generator(5);
    scalar largest = 0;
    for (label sample = 0; sample < 12; ++sample)
    {
        const vector normal = normalised(uniformVector(generator));
        for (label step = 0; step < 4; ++step)
        {
            const point origin = point(0.5, 0.5, 0.5) + 0.27 * step * h * normal;
            const Shape plane = halfSpace(origin, normal);
            const auto result = method.extract(snapshotOf(complex, plane));
            for (const point& x : result.mesh.points)
            {
                // Two layers at the walls feel the boundary's fractions.
                if (cmptMax(cmptMag(x - point(0.5, 0.5, 0.5))) < 0.5 - 2 * h)
                {
                    largest = max(largest, mag(plane(x)) / h);
                }
            }
        }
    }
    return largest;
}

} // namespace Foam::stability::shapes
