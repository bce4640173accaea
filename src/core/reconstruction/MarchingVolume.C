// SPDX-License-Identifier: GPL-3.0-or-later

// The volume that MarchingTets encloses, by the divergence theorem.

#include "core/reconstruction/MarchingTets.H"

namespace Foam::stability
{

std::optional<PeriodicImages::LinearField>
MarchingTets::volumeField(const WholeMesh& whole)
{
    const PeriodicImages none({}, whole.bounds, 1, 1);
    const PeriodicImages& images = whole.images ? *whole.images : none;
    if (!whole.section)
    {
        return images.invariantField();
    }
    // The two planes of a section count for nothing; a wedge has no such field.
    return whole.section->wedge && whole.images
               ? std::nullopt
               : images.invariantField(whole.section->normal);
}

void MarchingTets::closeWhole(label facei)
{
    if (complex_.whole().section)
    {
        addBoundary(
            volumeTo(complex_.faceCentres()[facei], complex_.faceAreas()[facei]), facei
        );
        return;
    }
    const face& f = complex_.faces()[facei];
    forAll(f, k)
    {
        addBoundary(
            volumeTo(
                {complex_.faceCentres()[facei], complex_.points()[f[k]],
                 complex_.points()[f.nextLabel(k)]}
            ),
            facei
        );
    }
}

void MarchingTets::addBoundary(scalar volume, label facei)
{
    if (complex_.own(complex_.owner()[facei]))
    {
        boundaryVolume_.add(volume);
    }
}

scalar MarchingTets::volumeTo(const FixedList<point, 3>& corners) const
{
    const point& a = corners[0];
    return volumeTo(
        (a + corners[1] + corners[2]) / 3, 0.5 * ((corners[1] - a) ^ (corners[2] - a))
    );
}

// The flux of the field of divergence 1; in a wedge the volume of a cone.
scalar MarchingTets::volumeTo(const point& centre, const vector& area) const
{
    if (!field_)
    {
        return 0;
    }
    const std::optional<PlaneSection>& section = complex_.whole().section;
    if (section && section->wedge)
    {
        return section->coneTo(centre, area, field_->centre).volume;
    }
    return ((*field_)(centre)&area) * (section ? section->factor(centre) : 1);
}

std::optional<ExactSum> MarchingTets::volume() const
{
    if (!field_)
    {
        return std::nullopt;
    }
    ExactSum sum(boundaryVolume_);
    forAll(triangles_, trianglei)
    {
        if (complex_.own(triangleCells_[trianglei]))
        {
            const triFace& t = triangles_[trianglei];
            sum.add(volumeTo({points_[t[0]], points_[t[1]], points_[t[2]]}));
        }
    }
    return sum;
}

} // namespace Foam::stability
