// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/results/PieceList.H"

namespace Foam::stability
{

namespace
{

std::string declaration(const PointArray& array)
{
    return std::string("      <PDataArray type=\"")
           + (array.integer ? "Int32" : "Float64") + "\" Name=\"" + array.name
           + "\" NumberOfComponents=\"" + std::to_string(array.nComponents) + "\"/>\n";
}

} // namespace

bool isTexture(const PointArray& array)
{
    return array.name == "TCoords" && array.nComponents == 2;
}

std::string
pieceList(const ResultSurface& aPiece, const std::vector<std::string>& pieces)
{
    std::string texture, arrays;
    for (const PointArray& array : aPiece.arrays)
    {
        texture = isTexture(array) ? " TCoords=\"" + array.name + "\"" : texture;
        arrays += declaration(array);
    }
    std::string text = "<?xml version=\"1.0\"?>\n"
                       "<VTKFile type=\"PPolyData\" version=\"1.0\" "
                       "byte_order=\"LittleEndian\">\n"
                       "  <PPolyData GhostLevel=\"0\">\n"
                       "    <PPointData"
                       + texture + ">\n" + arrays
                       + "    </PPointData>\n"
                         "    <PPoints>\n"
                       + declaration({"Points", 3, false, {}}) + "    </PPoints>\n";
    for (const std::string& piece : pieces)
    {
        text += "    <Piece Source=\"" + piece + "\"/>\n";
    }
    return text + "  </PPolyData>\n</VTKFile>\n";
}

} // namespace Foam::stability
