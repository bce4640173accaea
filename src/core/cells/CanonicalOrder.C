// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CanonicalOrder.H"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

namespace Foam::stability
{

bool beforeByPosition(const point& a, const point& b)
{
    for (direction d = 0; d < 3; ++d)
    {
        if (a[d] != b[d])
        {
            return a[d] < b[d];
        }
    }
    return false;
}

point cellMean(
    const UList<label>& cellFaces, const UList<face>& faces, const UList<point>& points
)
{
    static thread_local std::vector<label> around;
    around.clear();
    for (const label facei : cellFaces)
    {
        around.insert(around.end(), faces[facei].begin(), faces[facei].end());
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    point sum(Zero);
    for (const label pointi : around)
    {
        sum += points[pointi];
    }
    return sum / scalar(around.size());
}

namespace
{

labelList inverse(const labelList& order)
{
    labelList result(order.size());
    forAll(order, i)
    {
        result[order[i]] = i;
    }
    return result;
}

template<class List>
List permuted(const List& values, const labelList& order)
{
    List result(order.size());
    forAll(order, i)
    {
        result[i] = values[order[i]];
    }
    return result;
}

// Permutes a list that is not empty.
template<class List>
void permute(List& values, const labelList& order)
{
    if (!values.empty())
    {
        values = permuted(values, order);
    }
}

template<class Before>
labelList sortedBy(label n, const Before& before)
{
    labelList order(n);
    std::iota(order.begin(), order.end(), label(0));
    std::stable_sort(order.begin(), order.end(), before);
    return order;
}

// The keys by which points or cells are sorted.
class Places
{
public:
    Places() = default;
    Places(pointField&& homes, labelList&& images)
        : homes_(std::move(homes)), images_(std::move(images))
    {
    }

    bool before(label a, label b) const
    {
        return homes_[a] == homes_[b] ? image(a) < image(b)
                                      : beforeByPosition(homes_[a], homes_[b]);
    }
    bool same(label a, label b) const
    {
        return homes_[a] == homes_[b] && image(a) == image(b);
    }

private:
    label image(label i) const { return images_.empty() ? 0 : images_[i]; }

    pointField homes_; // [m]
    labelList images_; // empty: there are none
};

class Ordering
{
public:
    explicit Ordering(CellComplexInput& mesh)
        : mesh_(mesh), nInternal_(mesh.neighbour.size()), nCells_(mesh.nCells),
          images_(mesh.whole ? mesh.whole->images.get() : nullptr)
    {
    }

    CanonicalOrder run()
    {
        orderPoints();
        orderCells();
        turnFaces();
        orderFaces();
        return std::move(order_);
    }

private:
    Places placesOfPoints() const
    {
        if (!images_)
        {
            return Places(pointField(mesh_.points), labelList());
        }
        labelList images(mesh_.globalPoints);
        for (label& image : images)
        {
            image = images_->imageOfPoint(image);
        }
        return Places(pointField(mesh_.homes), std::move(images));
    }

    Places placesOfCells() const
    {
        if (images_)
        {
            labelList images(mesh_.globalCells);
            for (label& image : images)
            {
                image = images_->imageOfCell(image);
            }
            return Places(pointField(mesh_.cellHomes), std::move(images));
        }
        const Rows cellFaces = facesOfCells(mesh_);
        pointField means(nCells_);
        forAll(means, celli)
        {
            means[celli] = cellMean(cellFaces[celli], mesh_.faces, mesh_.points);
        }
        return Places(std::move(means), labelList());
    }

    void orderPoints()
    {
        const Places places(placesOfPoints());
        order_.points = sortedBy(
            mesh_.points.size(), [&](label a, label b) { return places.before(a, b); }
        );
        applyPoints(order_.points);
        separateCoincident();
    }

    void applyPoints(const labelList& order)
    {
        const labelList toNew = inverse(order);
        mesh_.points = permuted(mesh_.points, order);
        permute(mesh_.globalPoints, order);
        permute(mesh_.homes, order);
        for (face& f : mesh_.faces)
        {
            for (label& pointi : f)
            {
                pointi = toNew[pointi];
            }
        }
    }

    // On both sides of a baffle there are points at one place: they are told apart by
    // the lowest of the cells around them.
    void separateCoincident()
    {
        const Places points(placesOfPoints());
        const label n = mesh_.points.size();
        bool any = false;
        for (label i = 1; i < n && !any; ++i)
        {
            any = points.same(i, i - 1);
        }
        if (!any)
        {
            return;
        }
        const Places cells(placesOfCells());
        labelList lowest(n, -1);
        const auto lower = [&](label pointi, label celli)
        {
            if (lowest[pointi] < 0 || cells.before(celli, lowest[pointi]))
            {
                lowest[pointi] = celli;
            }
        };
        forAll(mesh_.faces, facei)
        {
            for (const label pointi : mesh_.faces[facei])
            {
                lower(pointi, mesh_.owner[facei]);
                if (facei < nInternal_)
                {
                    lower(pointi, mesh_.neighbour[facei]);
                }
            }
        }
        const labelList order = sortedBy(
            n,
            [&](label a, label b)
            {
                if (!points.same(a, b) || lowest[a] < 0 || lowest[b] < 0)
                {
                    return points.before(a, b)
                           || (points.same(a, b) && lowest[b] < 0 && lowest[a] >= 0);
                }
                return cells.before(lowest[a], lowest[b]);
            }
        );
        order_.points = permuted(order_.points, order);
        applyPoints(order);
    }

    void orderCells()
    {
        const Places places(placesOfCells());
        order_.cells =
            sortedBy(nCells_, [&](label a, label b) { return places.before(a, b); });
        permute(mesh_.globalCells, order_.cells);
        permute(mesh_.cellHomes, order_.cells);
        const labelList toNew = inverse(order_.cells);
        for (labelList* cells : {&mesh_.owner, &mesh_.neighbour})
        {
            for (label& celli : *cells)
            {
                celli = toNew[celli];
            }
        }
    }

    void turnFaces()
    {
        forAll(mesh_.faces, facei)
        {
            face& f = mesh_.faces[facei];
            if (facei < nInternal_ && mesh_.owner[facei] > mesh_.neighbour[facei])
            {
                std::swap(mesh_.owner[facei], mesh_.neighbour[facei]);
                f.flip();
            }
            std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
        }
    }

    bool faceBefore(label a, label b) const
    {
        const auto key = [&](label facei)
        {
            return facei < nInternal_
                       ? std::make_tuple(mesh_.owner[facei], mesh_.neighbour[facei])
                       : std::make_tuple(label(-1), mesh_.patches[facei - nInternal_]);
        };
        const auto ka = key(a), kb = key(b);
        const face &fa = mesh_.faces[a], &fb = mesh_.faces[b];
        return ka != kb ? ka < kb
                        : std::lexicographical_compare(
                            fa.begin(), fa.end(), fb.begin(), fb.end()
                        );
    }

    void orderFaces()
    {
        order_.faces = labelList(mesh_.faces.size());
        std::iota(order_.faces.begin(), order_.faces.end(), label(0));
        const auto middle = order_.faces.begin() + nInternal_;
        const auto before = [&](label a, label b) { return faceBefore(a, b); };
        std::stable_sort(order_.faces.begin(), middle, before);
        std::stable_sort(middle, order_.faces.end(), before);

        mesh_.faces = permuted(mesh_.faces, order_.faces);
        mesh_.owner = permuted(mesh_.owner, order_.faces);
        const labelList internal(SubList<label>(order_.faces, nInternal_));
        mesh_.neighbour = permuted(mesh_.neighbour, internal);
        labelList boundary(
            SubList<label>(order_.faces, order_.faces.size() - nInternal_, nInternal_)
        );
        for (label& facei : boundary)
        {
            facei -= nInternal_;
        }
        mesh_.kinds = permuted(mesh_.kinds, boundary);
        mesh_.patches = permuted(mesh_.patches, boundary);
    }

    CellComplexInput& mesh_;
    label nInternal_;
    label nCells_;
    const PeriodicImages* images_; // null: there are none
    CanonicalOrder order_;
};

} // namespace

CanonicalOrder orderByPosition(CellComplexInput& mesh)
{
    return Ordering(mesh).run();
}

} // namespace Foam::stability
