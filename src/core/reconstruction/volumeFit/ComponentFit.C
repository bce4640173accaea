// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/volumeFit/ComponentFit.H"

#include "core/surface/InterfaceMotion.H"
#include "core/reconstruction/volumeFit/MaterialShares.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

constexpr scalar exact = 1e-9; // relative

class VolumeFitter
{
public:
    VolumeFitter(
        InterfaceMesh& mesh, const UList<bool>& whole, const CellComplex& complex,
        const VolumeFractions& fractions, label nThreads
    )
        : mesh_(mesh), complex_(complex), components_(mesh, whole),
          directions_(mesh.pointNormals()), moves_(mesh.points.size(), Zero),
          moved_(mesh.points), fitted_(components_.all.size(), 0)
    {
        for (const SurfaceComponent& component : components_.all)
        {
            result_.nClosed += component.closed;
        }
        if (result_.nClosed > 0)
        {
            smoothDirections();
            shares_ = materialShares(mesh, components_, complex, fractions, nThreads);
        }
    }

    ComponentFit run()
    {
        for (std::size_t i = 0; i < shares_.size(); ++i)
        {
            if (components_.all[i].closed)
            {
                fit(i);
            }
        }
        move();
        ComponentFit done;
        done.result = result_;
        done.moved.setSize(mesh_.triangles.size());
        forAll(done.moved, trianglei)
        {
            done.moved[trianglei] = fitted_[components_.ofTriangles[trianglei]];
        }
        return done;
    }

private:
    // Thin triangles have corners whose normals differ: where each corner goes its own
    // way, they flip.
    void smoothDirections()
    {
        constexpr label nSweeps = 5;
        for (label sweep = 0; sweep < nSweeps; ++sweep)
        {
            vectorField sums(directions_.size(), Zero);
            for (const triFace& t : mesh_.triangles)
            {
                const vector sum =
                    directions_[t[0]] + directions_[t[1]] + directions_[t[2]];
                sums[t[0]] += sum;
                sums[t[1]] += sum;
                sums[t[2]] += sum;
            }
            forAll(sums, pointi)
            {
                const scalar length = mag(sums[pointi]);
                directions_[pointi] =
                    length > VSMALL ? sums[pointi] / length : vector(Zero);
            }
        }
    }

    scalar target(std::size_t i) const
    {
        return components_.all[i].volume + shares_[i].gain;
    }

    bool isExact(std::size_t i, scalar volume) const
    {
        return mag(volume - target(i)) <= exact * mag(target(i));
    }

    // Its points, all by this distance [m] along their directions.
    scalar volumeAt(const SurfaceComponent& component, scalar distance)
    {
        for (const label pointi : component.points)
        {
            moved_[pointi] = mesh_.points[pointi] + distance * directions_[pointi];
        }
        return volumeWithin(component, mesh_.triangles, moved_);
    }

    void fit(std::size_t i)
    {
        constexpr scalar openShare = 1e-6;
        const SurfaceComponent& component = components_.all[i];
        if (shares_[i].openVolume > openShare * mag(target(i)))
        {
            ++result_.nOpen;
            return;
        }
        scalar smallest = GREAT;
        for (const label pointi : component.points)
        {
            smallest = std::min(smallest, mesh_.cellSizes[pointi]);
        }
        const scalar distance = distanceFor(i, largestFitMove * smallest);
        if (mag(distance) > largestFitMove * smallest)
        {
            ++result_.nTooFar;
        }
        else if (folds(component))
        {
            ++result_.nFolded;
        }
        else
        {
            fitted_[i] = 1;
            for (const label pointi : component.points)
            {
                moves_[pointi] = distance * directions_[pointi];
            }
        }
    }

    // By regula falsi and bisection, as the volume is monotonic within the limit; more
    // than the limit [m] where there is none.
    scalar distanceFor(std::size_t i, scalar limit)
    {
        constexpr label maxIterations = 100;
        const SurfaceComponent& component = components_.all[i];
        scalar low = -limit, high = limit;
        scalar lowExcess = volumeAt(component, low) - target(i);
        scalar highExcess = volumeAt(component, high) - target(i);
        scalar distance = 2 * limit;
        for (label n = 0; n < maxIterations && lowExcess < 0 && highExcess > 0; ++n)
        {
            const bool halve = n % 3 == 2;
            distance = halve
                           ? 0.5 * (low + high)
                           : low - lowExcess / (highExcess - lowExcess) * (high - low);
            const scalar volume = volumeAt(component, distance);
            if (isExact(i, volume))
            {
                break;
            }
            (volume < target(i) ? low : high) = distance;
            (volume < target(i) ? lowExcess : highExcess) = volume - target(i);
        }
        return distance;
    }

    bool folds(const SurfaceComponent& component) const
    {
        const auto area = [](const pointField& x, const triFace& t)
        { return (x[t[1]] - x[t[0]]) ^ (x[t[2]] - x[t[0]]); };
        return std::any_of(
            component.triangles.begin(), component.triangles.end(),
            [&](label trianglei)
            {
                const triFace& t = mesh_.triangles[trianglei];
                return (area(mesh_.points, t) & area(moved_, t)) <= 0;
            }
        );
    }

    // Components that walls do not let move as far as they should stay where they are.
    void move()
    {
        const InterfaceMesh before(mesh_);
        for (bool again = true; again;)
        {
            mesh_ = before;
            result_.volume = moveInterface(mesh_, complex_, moves_);
            again = false;
            for (std::size_t i = 0; i < components_.all.size(); ++i)
            {
                const SurfaceComponent& component = components_.all[i];
                if (fitted_[i]
                    && !isExact(
                        i, volumeWithin(component, mesh_.triangles, mesh_.points)
                    ))
                {
                    again = true;
                    hold(i);
                }
            }
        }
        forAll(moves_, pointi)
        {
            const scalar move = mag(moves_[pointi]) / before.cellSizes[pointi];
            result_.largestMove = std::max(result_.largestMove, move);
        }
    }

    void hold(std::size_t i)
    {
        fitted_[i] = 0;
        ++result_.nHeld;
        for (const label pointi : components_.all[i].points)
        {
            moves_[pointi] = Zero;
        }
    }

    InterfaceMesh& mesh_;
    const CellComplex& complex_;
    SurfaceComponents components_;
    vectorField directions_;            // per point, unit or zero
    std::vector<MaterialShare> shares_; // per component
    vectorField moves_;                 // per point [m]
    pointField moved_;                  // for trial
    std::vector<char> fitted_;          // per component
    VolumeFitResult result_;
};

} // namespace

ComponentFit fitComponents(
    InterfaceMesh& mesh, const UList<bool>& whole, const CellComplex& complex,
    const VolumeFractions& fractions, label nThreads
)
{
    if (mesh.empty())
    {
        return {};
    }
    return VolumeFitter(mesh, whole, complex, fractions, nThreads).run();
}

} // namespace Foam::stability
