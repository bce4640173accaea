// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/NormalEquations.H"

#include "core/cells/CellStencil.H"
#include "core/reconstruction/sharpening/PlicFits.H"
#include "core/reconstruction/sharpening/SectionShape.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

namespace
{

class PlicFitter
{
public:
    PlicFitter(const CellComplex& complex, const scalarField& alpha, label nThreads)
        : complex_(complex), alpha_(alpha), nThreads_(nThreads)
    {
    }

    PlicFits run()
    {
        findCells();
        findJumps();
        listByCell();
        placeAll();
        fitAll();
        aim();
        placeAll();
        fitAll();
        for (label i = 0; i < result_.nCells; ++i)
        {
            result_.nFailed += !result_.planes[i].converged;
        }
        return std::move(result_);
    }

private:
    // A mixed cell counts where it is well mixed or a neighbour is on the other side:
    // whatever else has a trace of both is a wisp.
    bool carriesInterface(CellStencil& stencil, label celli) const
    {
        const scalar alpha = alpha_[celli];
        constexpr scalar wellMixed = 0.1;
        if (std::min(alpha, 1 - alpha) > wellMixed)
        {
            return true;
        }
        const UList<label>& around = stencil.rings(celli, 1);
        return std::any_of(
            around.begin(), around.end(),
            [&](label other) {
                return VolumeFractions::inside(alpha_[other])
                       != VolumeFractions::inside(alpha);
            }
        );
    }

    void findCells()
    {
        CellStencil stencil(complex_);
        for (const label celli : cellsWhere(alpha_, isMixed))
        {
            if (carriesInterface(stencil, celli))
            {
                InterfaceFit fit(fitOf(celli));
                const vector g =
                    gradientOver(complex_, stencil.rings(celli, 1), alpha_, fit.frame);
                constexpr scalar roundOff = 1e-9; // of a gradient that is none
                fit.normal =
                    fit.frame.along(g) > roundOff ? vector(g / mag(g)) : vector(Zero);
                result_.fits.append(fit);
                result_.planes.append(PlicPlane());
            }
        }
        result_.nCells = result_.fits.size();
    }

    InterfaceFit fitOf(label celli) const
    {
        constexpr scalar inHexahedra = 2, elsewhere = 1.6;
        InterfaceFit fit;
        fit.cell = celli;
        fit.frame = fit.metric = frameOf(complex_, celli);
        fit.reach = complex_.cellFaces()[celli].size() == 6 ? inHexahedra : elsewhere;
        fit.across = complex_.whole().across();
        return fit;
    }

    // Adds the faces across which the fraction jumps from 1 to 0, as at every start
    // from setFields: there the interface is the face.
    void findJumps()
    {
        for (label facei = 0; facei < complex_.nInternalFaces(); ++facei)
        {
            const label owner = complex_.owner()[facei];
            const scalar a = alpha_[owner], b = alpha_[complex_.neighbour()[facei]];
            if (std::max(a, b) < 1 - trace || std::min(a, b) > trace)
            {
                continue;
            }
            const vector S = a > b ? -complex_.faceAreas()[facei]
                                   : vector(complex_.faceAreas()[facei]);
            PlicPlane plane;
            plane.area = mag(S);
            plane.normal = S / std::max(plane.area, scalar(VSMALL));
            plane.centre = complex_.faceCentres()[facei];
            plane.secondMoment = momentOf(facei, plane);
            plane.converged = true;
            InterfaceFit fit(fitOf(owner));
            placeOnFace(fit, plane);
            result_.fits.append(fit);
            result_.planes.append(plane);
        }
    }

    // The polygon's area in the frame; in two dimensions its length.
    scalar extentOf(const PlicPlane& plane, const CellFrame& frame) const
    {
        const std::optional<PlaneSection>& section = complex_.whole().section;
        const scalar widths =
            section ? frame.along(section->normal) / section->thickness : 1;
        return widths * frame.area(plane.area * plane.normal);
    }

    symmTensor momentOf(label facei, const PlicPlane& plane) const
    {
        const face& f = complex_.faces()[facei];
        const WholeMesh& whole = complex_.whole();
        symmTensor moment(Zero);
        scalar area = 0;
        forAll(f, k)
        {
            const vector a = complex_.points()[f[k]] - plane.centre;
            const vector b = complex_.points()[f.nextLabel(k)] - plane.centre;
            const scalar part = 0.5 * mag(a ^ b);
            const vector u = whole.inPlane(a), v = whole.inPlane(b);
            moment += part / 12 * (sqr(u) + sqr(v) + sqr(u + v));
            area += part;
        }
        return moment / std::max(area, scalar(VSMALL));
    }

    void listByCell()
    {
        byCell_ = Rows(
            complex_.nCells(),
            [&](auto&& add)
            {
                forAll(result_.fits, i)
                {
                    add(result_.fits[i].cell, i);
                }
            }
        );
    }

    // Takes the normals of the first fits, which were made in the frames of the cells:
    // there noise turns normals least. From then on fits look around in rounded frames.
    void aim()
    {
        forAll(result_.fits, i)
        {
            InterfaceFit& fit = result_.fits[i];
            if (i < result_.nCells && fit.weight > 0)
            {
                const vector g = fit.gradient(-fit.a[1], -fit.a[2], 1);
                fit.normal = g / mag(g);
            }
            fit.metric = rounded(fit.frame);
            if (i >= result_.nCells)
            {
                placeOnFace(fit, result_.planes[i]);
            }
        }
    }

    void placeOnFace(InterfaceFit& fit, const PlicPlane& plane) const
    {
        fit.setPlane(plane.centre, plane.normal);
        fit.weight = extentOf(plane, fit.metric);
    }

    void placeAll()
    {
#pragma omp parallel for schedule(dynamic, 64) num_threads(nThreads_)
        for (label i = 0; i < result_.nCells; ++i)
        {
            place(result_.fits[i], result_.planes[i]);
        }
    }

    void place(InterfaceFit& fit, PlicPlane& plane) const
    {
        const scalar alpha = alpha_[fit.cell];
        if (fit.normal == vector(Zero))
        {
            fit.weight = 0; // nothing tells where the interface points
            plane = PlicPlane();
            return;
        }
        plane = planeIn(complex_, fit.cell, fit.normal, alpha);
        const point centre =
            plane.converged ? plane.centre : complex_.cellCentres()[fit.cell];
        fit.setPlane(centre, plane.normal);
        fit.weight = plane.converged
                         ? sqr(4 * alpha * (1 - alpha)) * extentOf(plane, fit.metric)
                         : 0;
    }

    void fitAll()
    {
        List<InterfaceFit> fitted(result_.fits);
#pragma omp parallel num_threads(nThreads_)
        {
            CellStencil stencil(complex_);
#pragma omp for schedule(dynamic, 64)
            for (label i = 0; i < fitted.size(); ++i)
            {
                fit(stencil, fitted[i]);
            }
        }
        forAll(fitted, i)
        {
            result_.fits[i] = fitted[i];
        }
    }

    // One ring of neighbours leaves the curvature across a wall undetermined; behind
    // the axis of a wedge there are the mirrored ones.
    void fit(CellStencil& stencil, InterfaceFit& own) const
    {
        if (!(own.weight > 0))
        {
            return;
        }
        NormalEquations<6> equations;
        const bool atAxis = touchesAxis(own.cell);
        const label nRings = !atAxis && touchesBoundary(complex_, own.cell) ? 2 : 1;
        for (const label celli : stencil.rings(own.cell, nRings))
        {
            for (const label i : byCell_[celli])
            {
                addPlane(result_.planes[i], result_.fits[i].weight, own, equations);
                if (atAxis && touchesAxis(celli))
                {
                    const PlicPlane other(mirrored(result_.planes[i]));
                    addPlane(other, result_.fits[i].weight, own, equations);
                }
            }
        }
        take(equations, own);
    }

    static void addPlane(
        const PlicPlane& plane, scalar weight, const InterfaceFit& own,
        NormalEquations<6>& equations
    )
    {
        constexpr scalar sigma = 1.5; // in cells
        if (weight > 0
            && own.frame.alignment(plane.normal, own.normal) > smallestAlignment)
        {
            const vector x = own.local(plane.centre);
            const tensor moment = own.axes & plane.secondMoment & own.axes.T();
            NormalEquations<6>::Vector row;
            row << 1, x.x(), x.y(), sqr(x.x()) + moment.xx(),
                x.x() * x.y() + moment.xy(), sqr(x.y()) + moment.yy();
            equations.add(row, x.z(), weight * std::exp(-magSqr(x) / sqr(sigma)));
        }
    }

    bool touchesAxis(label celli) const
    {
        constexpr scalar onAxis = 1e-6; // in cells
        const std::optional<PlaneSection>& section = complex_.whole().section;
        if (!section || !section->wedge)
        {
            return false;
        }
        const auto isOn = [&](label pointi)
        {
            return section->radius(complex_.points()[pointi])
                   < onAxis * complex_.cellSizes()[celli];
        };
        for (const label facei : complex_.cellFaces()[celli])
        {
            const face& f = complex_.faces()[facei];
            if (std::any_of(f.begin(), f.end(), isOn))
            {
                return true;
            }
        }
        return false;
    }

    // The plane on the other side of the axis of a wedge: the interface goes on there.
    PlicPlane mirrored(const PlicPlane& plane) const
    {
        const PlaneSection& section = *complex_.whole().section;
        const tensor mirror = I - 2 * sqr(section.axis ^ section.normal);
        PlicPlane other(plane);
        other.centre =
            section.axisPoint + (mirror & (plane.centre - section.axisPoint));
        other.normal = mirror & plane.normal;
        other.secondMoment = symm(mirror & plane.secondMoment & mirror);
        return other;
    }

    // The plane stays if neighbours do not tell.
    void take(const NormalEquations<6>& equations, InterfaceFit& own) const
    {
        const int fewest = complex_.whole().section ? 3 : 5;
        constexpr scalar linear = 1e-5, quadratic = 1e-4;
        constexpr scalar farthest = 0.3, steepest = 1;
        NormalEquations<6>::Vector x;
        if (equations.nRows() >= fewest && equations.solve<6>(2, linear, quadratic, x)
            && std::abs(x[0]) <= farthest && std::hypot(x[1], x[2]) <= steepest
            && x.tail<3>().cwiseAbs().maxCoeff() <= largestCurvature)
        {
            std::copy(x.data(), x.data() + 6, own.a.begin());
        }
    }

    const CellComplex& complex_;
    const scalarField& alpha_;
    label nThreads_;
    PlicFits result_;
    Rows byCell_;
};

} // namespace

PlicFits
fitPlic(const CellComplex& complex, const VolumeFractions& fractions, label nThreads)
{
    return PlicFitter(complex, fractions.cells, nThreads).run();
}

} // namespace Foam::stability
