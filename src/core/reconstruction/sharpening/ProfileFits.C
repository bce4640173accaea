// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/NormalEquations.H"

#include "core/cells/BoxTree.H"
#include "core/cells/CellStencil.H"
#include "core/reconstruction/sharpening/ProfileFits.H"

#include "core/reconstruction/sharpening/FaceSmoothing.H"
#include <algorithm>
#include <cmath>

namespace Foam::stability
{

namespace
{

constexpr scalar saturated = 1e-3; // the logit is clamped there
constexpr scalar sigma = 1.5;      // reach of the weights along the interface, in cells
constexpr scalar farthestCentre =
    1.5; // way from the centre of a cell to its fit, in cells

scalar logit(scalar beta)
{
    const scalar b = std::min(std::max(beta, saturated), 1 - saturated);
    return std::log(b / (1 - b));
}

// A cell of a stencil in the frame of a fit.
struct Sample
{
    vector x;
    scalar beta;
    scalar weight; // by the way along the interface
    bool saturated;
};

class ProfileFitter
{
public:
    ProfileFitter(
        const CellComplex& complex, const scalarField& alpha, const pointField& points,
        label nThreads
    )
        : complex_(complex), beta_(smoothedOverFaces(complex, alpha)),
          logits_(alpha.size()), gradients_(alpha.size()), nThreads_(nThreads)
    {
        List<boundBox> boxes(points.size());
        forAll(points, i)
        {
            const point x = complex.whole().inMiddle(points[i]);
            boxes[i] = boundBox(x, x);
        }
        points_ = BoxTree(boxes);
    }

    ProfileFits run()
    {
        std::transform(beta_.begin(), beta_.end(), logits_.begin(), logit);
        findAnchors();
        findGradients();
        std::vector<char> failed(result_.fits.size(), 0);
#pragma omp parallel num_threads(nThreads_)
        {
            CellStencil stencil(complex_);
            std::vector<Sample> samples;
#pragma omp for schedule(dynamic, 64)
            for (label i = 0; i < result_.fits.size(); ++i)
            {
                failed[i] = !fit(stencil, samples, result_.fits[i]);
            }
        }
        result_.nFailed = std::count(failed.begin(), failed.end(), 1);
        return std::move(result_);
    }

private:
    void findAnchors()
    {
        CellStencil stencil(complex_);
        for (const label celli : cellsWhere(beta_, isMixed))
        {
            const scalar beta = beta_[celli];
            const UList<label>& around = stencil.rings(celli, 1);
            constexpr scalar wellMixed = 0.1;
            const bool carries = std::min(beta, 1 - beta) > wellMixed
                                 || std::any_of(
                                     around.begin(), around.end(),
                                     [&](label other) {
                                         return VolumeFractions::inside(beta_[other])
                                                != VolumeFractions::inside(beta);
                                     }
                                 );
            if (carries)
            {
                InterfaceFit fit;
                fit.cell = celli;
                fit.frame = fit.metric = frameOf(complex_, celli);
                fit.reach = 2;
                fit.across = complex_.whole().across();
                const vector wide =
                    (fit.reach + farthestCentre) * fit.frame.halfWidths();
                const point& x = complex_.cellCentres()[celli];
                if (points_.meets(boundBox(x - wide, x + wide)))
                {
                    result_.fits.append(fit);
                }
            }
        }
    }

    // The gradients of beta in all cells that a fit may look at.
    void findGradients()
    {
        CellStencil stencil(complex_);
        const UList<label>& cells = stencil.rings(cellsWhere(beta_, isMixed), 2);
#pragma omp parallel for schedule(static) num_threads(nThreads_)
        for (label i = 0; i < cells.size(); ++i)
        {
            const CellFrame frame(frameOf(complex_, cells[i]));
            const vector g = gradientOver(
                complex_, complex_.pointNeighbours(cells[i]), beta_, frame
            );
            gradients_[cells[i]] = frame.along(g) / (mag(g) + VSMALL) * g;
        }
    }

    // False where only the plane of the gradient is left.
    bool
    fit(CellStencil& stencil, std::vector<Sample>& samples, InterfaceFit& own) const
    {
        const scalar beta = beta_[own.cell];
        constexpr scalar certain = 0.01, doubt = 0.05;
        const vector g =
            gradientOver(complex_, stencil.rings(own.cell, 1), logits_, own.frame);
        const scalar slope = own.frame.along(g); // per cell
        own.weight =
            beta > certain && beta < 1 - certain ? sqr(4 * beta * (1 - beta)) : 0;
        if (!(slope > VSMALL))
        {
            own.weight = 0;
            return false;
        }
        const scalar toSurface = std::min(
            std::max(logits_[own.cell] / slope, -farthestCentre), farthestCentre
        );
        const vector normal = g / mag(g);
        const point centre =
            complex_.cellCentres()[own.cell] - own.frame.step(normal, toSurface);
        own.setPlane(centre, normal);

        const UList<label>& cells = stencil.rings(own.cell, 2);
        scalar steepness = slope;
        if (!fitLogits(cells, true, own, steepness)
            || !fitLogits(cells, false, own, steepness))
        {
            own.setPlane(centre, normal);
            own.weight *= doubt;
            return false;
        }
        takeSamples(cells, own, samples);
        matchMoments(samples, std::min(std::max(steepness, 1.5), 8.0), own);
        own.a[0] -=
            smoothedSquare(complex_, own.cell, own.frame) * (own.a[3] + own.a[5]);
        return true;
    }

    bool isSaturated(label celli) const
    {
        return beta_[celli] <= saturated || beta_[celli] >= 1 - saturated;
    }

    bool isAligned(label celli, const InterfaceFit& own, scalar least) const
    {
        const vector& g = gradients_[celli];
        const scalar length = mag(g);
        return length <= least
               || own.frame.alignment(g / length, own.normal) >= smallestAlignment;
    }

    // The logit as a quadratic function; re-aims the frame, or takes its zero as the
    // surface. `steepness` is the slope of the logit, per cell.
    bool fitLogits(
        const UList<label>& cells, bool reaim, InterfaceFit& own, scalar& steepness
    ) const
    {
        constexpr scalar across = 2.5, negligible = 1e-9;
        NormalEquations<7> equations;
        for (const label celli : cells)
        {
            if (isSaturated(celli) || !isAligned(celli, own, trace))
            {
                continue;
            }
            const vector x = own.local(complex_.cellCentres()[celli]);
            const scalar u = x.x(), v = x.y(), w = x.z(), beta = beta_[celli];
            const scalar weight =
                4 * beta * (1 - beta)
                * std::exp(-(u * u + v * v) / sqr(sigma) - w * w / sqr(across));
            if (weight > negligible)
            {
                NormalEquations<7>::Vector row;
                row << 1, u, v, w, u * u, u * v, v * v;
                equations.add(row, logits_[celli], weight);
            }
        }
        NormalEquations<7>::Vector b;
        if (!solveLogits(equations, steepness, b))
        {
            return false;
        }
        constexpr scalar steepest = 1.2, farthest = 1;
        const scalar offset = -b[0] / b[3];
        if (std::hypot(b[1], b[2]) > steepest * b[3] || std::abs(offset) > farthest)
        {
            return false;
        }
        steepness = b[3];
        if (reaim)
        {
            const vector n = own.gradient(b[1], b[2], b[3]);
            const vector normal = n / mag(n);
            own.setPlane(own.centre + own.frame.step(normal, offset), normal);
            return true;
        }
        own.a = {offset,       -b[1] / b[3], -b[2] / b[3],
                 -b[4] / b[3], -b[5] / b[3], -b[6] / b[3]};
        return true;
    }

    // With curvature if it is believable, else without.
    bool solveLogits(
        const NormalEquations<7>& equations, scalar steepness,
        NormalEquations<7>::Vector& b
    ) const
    {
        const bool isSection = bool(complex_.whole().section);
        const int fewest = isSection ? 3 : 4, fewestCurved = isSection ? 4 : 7;
        constexpr scalar linear = 1e-6, quadratic = 1e-4, plane = 1e-5, flattest = 0.1;
        if (equations.nRows() < fewest)
        {
            return false;
        }
        return (equations.nRows() >= fewestCurved
                && equations.solve<7>(3, linear, quadratic, b)
                && b[3] > flattest * steepness
                && b.tail<3>().cwiseAbs().maxCoeff() <= largestCurvature * b[3])
               || (equations.solve<4>(3, plane, plane, b) && b[3] > trace);
    }

    // Without those that point elsewhere.
    void takeSamples(
        const UList<label>& cells, const InterfaceFit& own, std::vector<Sample>& samples
    ) const
    {
        constexpr scalar clear = 0.02;
        samples.clear();
        for (const label celli : cells)
        {
            const bool saturated = isSaturated(celli);
            if (saturated || isAligned(celli, own, clear))
            {
                const vector x = own.local(complex_.cellCentres()[celli]);
                const scalar u = x.x(), v = x.y();
                samples.push_back(
                    {x, beta_[celli], std::exp(-(u * u + v * v) / sqr(sigma)),
                     saturated}
                );
            }
        }
    }

    // Moves the surface until the moments of the fractions over it are those of a
    // logistic profile. What leaves the limits on the way is not taken.
    void matchMoments(
        const std::vector<Sample>& samples, scalar steepness, InterfaceFit& own
    ) const
    {
        constexpr label nSteps = 3;
        constexpr scalar linear = 1e-6, quadratic = 1e-4, farthest = 0.8, steepest = 1;
        InterfaceFit moved(own);
        for (label step = 0; step < nSteps; ++step)
        {
            NormalEquations<6> equations;
            for (const Sample& s : samples)
            {
                addMoments(s, steepness, moved, equations);
            }
            NormalEquations<6>::Vector b;
            if (!equations.solve<6>(2, linear, quadratic, b))
            {
                return;
            }
            for (label k = 0; k < 6; ++k)
            {
                moved.a[k] += b[k];
            }
            const auto& a = moved.a;
            const scalar curvature =
                std::max(std::abs(a[3]), std::max(std::abs(a[4]), std::abs(a[5])));
            if (std::abs(a[0]) > farthest || std::hypot(a[1], a[2]) > steepest
                || curvature > largestCurvature)
            {
                return;
            }
        }
        own = moved;
    }

    // Newton's equations, as least squares weighted by the slope of the profile.
    void addMoments(
        const Sample& s, scalar steepness, const InterfaceFit& fit,
        NormalEquations<6>& equations
    ) const
    {
        constexpr scalar farthest = 3, least = 1e-12;
        const scalar u = s.x.x(), v = s.x.y(), beta = s.beta;
        const scalar z = s.x.z() - fit.height(u, v);
        if (std::abs(z) > farthest || (s.saturated && (beta > 0.5) != (z > 0)))
        {
            return;
        }
        const scalar profile = 1 / (1 + std::exp(-steepness * z));
        const scalar slope = std::max(steepness * profile * (1 - profile), least);
        NormalEquations<6>::Vector row;
        row << 1, u, v, u * u, u * v, v * v;
        equations.add(row, (profile - beta) / slope, s.weight * slope);
    }

    const CellComplex& complex_;
    scalarField beta_;
    scalarField logits_;
    vectorField gradients_; // of beta; their lengths are per cell
    label nThreads_;
    BoxTree points_;
    ProfileFits result_;
};

} // namespace

ProfileFits fitProfiles(
    const CellComplex& complex, const VolumeFractions& fractions,
    const pointField& points, label nThreads
)
{
    return ProfileFitter(complex, fractions.cells, points, nThreads).run();
}

} // namespace Foam::stability
