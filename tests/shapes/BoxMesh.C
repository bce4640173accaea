// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/BoxMesh.H"

#include "DynamicList.H"

namespace Foam::stability::shapes
{

namespace
{

class BoxBuilder
{
public:
    explicit BoxBuilder(const BoxOptions& options) : options_(options), n_(options.n) {}

    CellComplexInput build()
    {
        addPoints();
        addInternalFaces();
        const char* names[6] = {"xMin", "xMax", "yMin", "yMax", "zMin", "zMax"};
        input_.patchNames.setSize(6);
        for (label side = 0; side < 6; ++side)
        {
            input_.patchNames[side] = names[side];
            addSide(side);
        }
        input_.nCells = n_.x() * n_.y() * n_.z();
        input_.points.transfer(points_);
        input_.faces.transfer(faces_);
        input_.owner.transfer(owner_);
        input_.neighbour.transfer(neighbour_);
        input_.kinds.transfer(kinds_);
        input_.patches.transfer(patches_);
        return std::move(input_);
    }

private:
    label pointId(label i, label j, label k) const
    {
        return i + (n_.x() + 1) * (j + (n_.y() + 1) * k);
    }
    label cellId(label i, label j, label k) const
    {
        return i + n_.x() * (j + n_.y() * k);
    }

    void addPoints()
    {
        const vector span = options_.max - options_.min;
        for (label k = 0; k <= n_.z(); ++k)
        {
            for (label j = 0; j <= n_.y(); ++j)
            {
                for (label i = 0; i <= n_.x(); ++i)
                {
                    const vector s(
                        scalar(i) / n_.x(), scalar(j) / n_.y(), scalar(k) / n_.z()
                    );
                    const point x = options_.min + cmptMultiply(s, span);
                    points_.append(options_.map ? options_.map(x) : x);
                }
            }
        }
    }

    // The face of cell (i, j, k) towards +d, with its normal along +d.
    face faceTowards(direction d, label i, label j, label k) const
    {
        if (d == 0)
        {
            return face{
                pointId(i + 1, j, k), pointId(i + 1, j + 1, k),
                pointId(i + 1, j + 1, k + 1), pointId(i + 1, j, k + 1)};
        }
        if (d == 1)
        {
            return face{
                pointId(i, j + 1, k), pointId(i, j + 1, k + 1),
                pointId(i + 1, j + 1, k + 1), pointId(i + 1, j + 1, k)};
        }
        return face{
            pointId(i, j, k + 1), pointId(i + 1, j, k + 1),
            pointId(i + 1, j + 1, k + 1), pointId(i, j + 1, k + 1)};
    }

    void addInternalFaces()
    {
        for (label k = 0; k < n_.z(); ++k)
        {
            for (label j = 0; j < n_.y(); ++j)
            {
                for (label i = 0; i < n_.x(); ++i)
                {
                    const Vector<label> cell(i, j, k);
                    for (direction d = 0; d < 3; ++d)
                    {
                        Vector<label> next(cell);
                        ++next[d];
                        if (next[d] < n_[d])
                        {
                            faces_.append(faceTowards(d, i, j, k));
                            owner_.append(cellId(i, j, k));
                            neighbour_.append(cellId(next.x(), next.y(), next.z()));
                        }
                    }
                }
            }
        }
    }

    void addSide(label side)
    {
        const direction d = side / 2;
        const bool upper = side % 2;
        const direction d1 = (d + 1) % 3;
        const direction d2 = (d + 2) % 3;
        for (label b = 0; b < n_[d2]; ++b)
        {
            for (label a = 0; a < n_[d1]; ++a)
            {
                Vector<label> cell(0, 0, 0);
                cell[d1] = a;
                cell[d2] = b;
                cell[d] = upper ? n_[d] - 1 : -1;
                face f = faceTowards(d, cell.x(), cell.y(), cell.z());
                if (!upper)
                {
                    f.flip();
                    cell[d] = 0;
                }
                faces_.append(f);
                owner_.append(cellId(cell.x(), cell.y(), cell.z()));
                kinds_.append(options_.kinds[side]);
                patches_.append(side);
            }
        }
    }

    const BoxOptions& options_;
    Vector<label> n_;
    CellComplexInput input_;
    DynamicList<point> points_;
    DynamicList<face> faces_;
    DynamicList<label> owner_;
    DynamicList<label> neighbour_;
    DynamicList<BoundaryKind> kinds_;
    DynamicList<label> patches_;
};

} // namespace

CellComplexInput boxInput(const BoxOptions& options)
{
    return BoxBuilder(options).build();
}

std::shared_ptr<const CellComplex> box(const BoxOptions& options)
{
    return std::make_shared<const CellComplex>(boxInput(options));
}

BoxOptions boxOf(label n)
{
    BoxOptions options;
    options.max = point(n, n, n);
    options.n = Vector<label>(n, n, n);
    return options;
}

BoxOptions oblongBox()
{
    BoxOptions options;
    options.max = point(1.2, 1, 1.1);
    options.n = Vector<label>(10, 9, 11);
    return options;
}

std::shared_ptr<const CellComplex> unitCube(label n)
{
    BoxOptions options;
    options.n = Vector<label>(n, n, n);
    return box(options);
}

} // namespace Foam::stability::shapes
