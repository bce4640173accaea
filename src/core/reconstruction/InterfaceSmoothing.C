// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/InterfaceSmoothing.H"
#include "core/surface/TaubinSmoothing.H"
#include "core/surface/InterfaceMotion.H"
#include "SubField.H"

namespace Foam::stability
{

ExactSum smoothInterface(InterfaceMesh& mesh, const CellComplex& complex, label pairs)
{
    TaubinOptions options;
    options.pairs = pairs;
    options.section = complex.whole().section;
    const vectorField boundaryNormals(SubField<vector>(
        complex.faceAreas(), complex.nBoundaryFaces(), complex.nInternalFaces()
    ));
    return moveInterface(
        mesh, complex, taubinDisplacements(mesh, boundaryNormals, options)
    );
}

} // namespace Foam::stability
