// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/sharpening/Sharpening.H"

#include "core/surface/Ribbon.H"
#include "core/surface/SurfaceTopology.H"
#include "core/cells/CellStencil.H"
#include "core/surface/InterfaceMotion.H"
#include "core/reconstruction/sharpening/PlicFits.H"
#include "core/reconstruction/sharpening/PointSharpener.H"
#include "core/reconstruction/sharpening/ProfileFits.H"

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>

namespace Foam::stability
{

namespace
{

class Sharpener
{
public:
    Sharpener(
        const InterfaceMesh& mesh, const CellComplex& complex,
        const VolumeFractions& fractions, Sharpening kind, label nThreads
    )
        : mesh_(mesh), complex_(complex), fractions_(fractions), kind_(kind),
          nThreads_(nThreads), starts_(mesh.points.size()), moves_(mesh.points.size())
    {
    }

    SharpeningResult run(InterfaceMesh& mesh)
    {
        findStarts();
        fit();
        untangle();
        holdFlips();
        vectorField moves(moves_.size());
        result_.spread.setSize(moves_.size());
        scalar shares = 0;
        forAll(moves, pointi)
        {
            const Move& move = moves_[pointi];
            const bool moved = move.nSteps > 0;
            moves[pointi] = move.total;
            const scalar size = starts_[pointi].frame.along(moves_[pointi].direction);
            result_.spread[pointi] =
                (moved ? move.spread : -size) / mesh_.cellSizes[pointi];
            result_.nRejected += !moved;
            shares += move.share;
        }
        result_.profileShare = shares / moves.size();
        result_.volume = moveInterface(mesh, complex_, moves);
        return std::move(result_);
    }

private:
    using Start = PointSharpener::Start;
    using Move = PointSharpener::Move;

    void findStarts()
    {
        const vectorField normals(pointNormals(mesh_, complex_.whole().section));
#pragma omp parallel for schedule(static) num_threads(nThreads_)
        for (label pointi = 0; pointi < mesh_.points.size(); ++pointi)
        {
            const CellFrame frame(frameOf(complex_, mesh_.cells[pointi]));
            starts_[pointi] = {
                complex_.whole().inMiddle(mesh_.points[pointi]),
                -normals[pointi],
                mesh_.cells[pointi],
                frame,
                rounded(frame),
                wallsAt(pointi)};
            moves_[pointi].direction = -normals[pointi];
        }
    }

    // The normals of the boundary faces that the point lies on, made orthogonal.
    std::vector<vector> wallsAt(label pointi) const
    {
        std::vector<vector> walls;
        if (mesh_.boundaryFaces[pointi] < 0)
        {
            return walls;
        }
        constexpr scalar onPlane = 1e-6, another = 1e-3;
        const point& x = mesh_.points[pointi];
        const Surroundings around(complex_, mesh_.cells[pointi]);
        for (const label facei : around.boundaryFaces)
        {
            const vector& S = complex_.faceAreas()[facei];
            vector n = S / std::max(mag(S), scalar(VSMALL));
            if (mag((x - complex_.faceCentres()[facei]) & n)
                > onPlane * mesh_.cellSizes[pointi])
            {
                continue;
            }
            for (const vector& w : walls)
            {
                n -= (n & w) * w;
            }
            if (mag(n) > another)
            {
                walls.push_back(n / mag(n));
            }
        }
        return walls;
    }

    // Profiles are fitted only where there is a point at which plic is in doubt.
    void fit()
    {
        if (kind_ != Sharpening::profile)
        {
            plic_ = fitPlic(complex_, fractions_, nThreads_);
            plicBlend_.emplace(complex_, plic_.fits);
        }
        const PointSharpener plicAlone(plicBlend_ ? &*plicBlend_ : nullptr, nullptr);
        const label n = starts_.size();
        std::vector<BlendedDistance> first(n);
        label nDoubtful = 0;
#pragma omp parallel for schedule(dynamic, 64) num_threads(nThreads_) \
    reduction(+ : nDoubtful)
        for (label pointi = 0; pointi < n; ++pointi)
        {
            first[pointi] = plicAlone.plicAt(starts_[pointi]);
            nDoubtful += !PointSharpener::isSharp(first[pointi]);
        }
        if (kind_ != Sharpening::plic && nDoubtful > 0)
        {
            profile_ = fitProfiles(complex_, fractions_, mesh_.points, nThreads_);
            profileBlend_.emplace(complex_, profile_.fits);
        }
        result_.nFits = plic_.fits.size() + profile_.fits.size();
        result_.nFailed = plic_.nFailed + profile_.nFailed;

        const PointSharpener both(sharpener());
#pragma omp parallel for schedule(dynamic, 64) num_threads(nThreads_)
        for (label pointi = 0; pointi < n; ++pointi)
        {
            if (starts_[pointi].normal != vector(Zero))
            {
                const Move move = both.move(starts_[pointi], first[pointi]);
                moves_[pointi] = move.nSteps > 0 ? move : moves_[pointi];
            }
        }
    }

    PointSharpener sharpener() const
    {
        return PointSharpener(
            plicBlend_ ? &*plicBlend_ : nullptr,
            profileBlend_ ? &*profileBlend_ : nullptr
        );
    }

    // Twice the area vector when the points have gone this share of their way.
    vector areaAt(const triFace& t, scalar share) const
    {
        const auto x = [&](label k) -> point
        { return mesh_.points[t[k]] + share * moves_[t[k]].total; };
        return (x(1) - x(0)) ^ (x(2) - x(0));
    }

    // The direction across the surface by the shortest way in the frame, by which
    // points move; of unit length. In a section it is the gradient.
    vector acrossAt(label pointi) const
    {
        const vector& g = moves_[pointi].direction;
        const symmTensor& extents = starts_[pointi].frame.extents;
        const vector across =
            complex_.whole().section ? g : vector(extents & (extents & g));
        return across / (mag(across) + VSMALL);
    }

    // Triangles face the second material, gradients the first. Both are looked at in
    // the frame: in space chords across a curved surface tilt triangles that are as
    // flat as the cells, as those of Schwarz's lantern, wherever their points are.
    vector facing(const triFace& t) const
    {
        return -(acrossAt(t[0]) + acrossAt(t[1]) + acrossAt(t[2]));
    }

    // If tetrahedra folded triangles over each other, their points are spread along
    // the surface.
    void untangle()
    {
        constexpr label maxSweeps = 10;
        Rows pointTriangles;
        for (label sweep = 0; sweep < maxSweeps; ++sweep)
        {
            std::vector<char> folded(moves_.size(), 0);
            bool any = false;
            for (const triFace& t : mesh_.triangles)
            {
                if ((areaAt(t, 1) & facing(t)) <= 0)
                {
                    any = true;
                    folded[t[0]] = folded[t[1]] = folded[t[2]] = 1;
                }
            }
            if (!any)
            {
                return;
            }
            if (sweep == 0)
            {
                pointTriangles =
                    trianglesAtPoints(mesh_.points.size(), mesh_.triangles);
            }
            spread(folded, pointTriangles);
        }
    }

    // To the middle of the neighbours, along the surface, all at once.
    void spread(const std::vector<char>& folded, const Rows& pointTriangles)
    {
        constexpr scalar longest = 0.5; // in cells
        const PointSharpener both(sharpener());
        std::vector<Move> moved(moves_.begin(), moves_.end());
        forAll(moves_, pointi)
        {
            const Start& start = starts_[pointi];
            const Move& old = moves_[pointi];
            if (!folded[pointi] || mesh_.boundaryFaces[pointi] >= 0 || old.nSteps == 0)
            {
                continue;
            }
            vector mean(Zero);
            label n = 0;
            for (const label trianglei : pointTriangles[pointi])
            {
                for (const label otheri : mesh_.triangles[trianglei])
                {
                    mean += starts_[otheri].x + moves_[otheri].total - start.x;
                    ++n;
                }
            }
            const vector d = mean / n - old.total;
            const vector g = old.direction, across = acrossAt(pointi);
            Move& move = moved[pointi];
            move.total += d - (d & g) / (across & g) * across;
            move.total += both.pull(start, move);
            if (mag(start.frame.local(move.total)) > longest)
            {
                move = old;
            }
        }
        std::copy(moved.begin(), moved.end(), moves_.begin());
        moveAlike();
    }

    // In two dimensions: both points of a pair.
    void moveAlike()
    {
        const std::optional<PlaneSection>& section = complex_.whole().section;
        const labelList pairs(section ? pairsAcross(mesh_, *section) : labelList());
        forAll(pairs, pointi)
        {
            moves_[std::max(pointi, pairs[pointi])].total = moves_[pointi].total;
        }
    }

    // Halves the moves around a triangle that they flip, then drops them.
    void holdFlips()
    {
        std::vector<char> held(moves_.size(), 0);
        for (bool any = true; any;)
        {
            std::vector<char> flipped(moves_.size(), 0);
            for (const triFace& t : mesh_.triangles)
            {
                const vector n = facing(t);
                if ((areaAt(t, 1) & n) <= 0 && (areaAt(t, 0) & n) > 0)
                {
                    flipped[t[0]] = flipped[t[1]] = flipped[t[2]] = 1;
                }
            }
            any = false;
            forAll(moves_, pointi)
            {
                if (flipped[pointi] && held[pointi] < 2)
                {
                    any = true;
                    ++held[pointi];
                    moves_[pointi].total *= held[pointi] == 1 ? 0.5 : 0;
                }
            }
        }
        result_.nHeld = held.size() - std::count(held.begin(), held.end(), 0);
    }

    const InterfaceMesh& mesh_;
    const CellComplex& complex_;
    const VolumeFractions& fractions_;
    Sharpening kind_;
    label nThreads_;
    List<Start> starts_;
    List<Move> moves_;
    PlicFits plic_;
    ProfileFits profile_;
    std::optional<FitBlend> plicBlend_, profileBlend_;
    SharpeningResult result_;
};

} // namespace

const std::vector<std::string>& sharpeningNames()
{
    // One string, so that a search for the name of a method of reconstruction finds its
    // row alone.
    static const std::vector<std::string> names = []
    {
        std::istringstream words("none plic profile auto");
        return std::vector<std::string>(std::istream_iterator<std::string>(words), {});
    }();
    return names;
}

SharpeningResult sharpen(
    InterfaceMesh& mesh, const CellComplex& complex, const VolumeFractions& fractions,
    Sharpening kind, label nThreads
)
{
    if (kind == Sharpening::none || mesh.empty())
    {
        return SharpeningResult();
    }
    return Sharpener(mesh, complex, fractions, kind, nThreads).run(mesh);
}

} // namespace Foam::stability
