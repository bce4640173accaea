// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/base/FileReplacement.H"
#include "core/base/Version.H"
#include "core/results/ParameterTexture.H"
#include "core/results/PieceList.H"
#include "vtk/SurfaceReader.H"
#include "vtk/VtpWriter.H"
#include "withoutVtk/Png.H"

#include <cstdint>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace Foam::stability
{

namespace
{

// A .vtp file whose arrays are appended to its text as raw bytes, each after its
// length.
class VtpFile
{
public:
    explicit VtpFile(const ResultSurface& surface)
    {
        text_
            << std::setprecision(std::numeric_limits<double>::max_digits10)
            << "<?xml version=\"1.0\"?>\n"
               "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
               "header_type=\"UInt64\">\n<PolyData>\n";
        fieldData(surface);
        const label nPoints = surface.points.size(),
                    nTriangles = surface.triangles.size();
        text_ << "<Piece NumberOfPoints=\"" << nPoints << "\" NumberOfVerts=\""
              << (nTriangles ? 0 : nPoints)
              << "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\""
              << nTriangles << "\">\n";
        pointData(surface);
        points(surface);
        cells(surface);
        text_ << "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    }

    std::string bytes() const
    {
        return text_.str() + appended_ + "\n</AppendedData>\n</VTKFile>\n";
    }

private:
    template<class T>
    void array(
        const std::string& type, const std::string& name, int nComponents,
        const std::vector<T>& values
    )
    {
        const std::uint64_t size = values.size() * sizeof(T);
        text_ << "<DataArray type=\"" << type << "\" Name=\"" << name
              << "\" NumberOfComponents=\"" << nComponents
              << "\" format=\"appended\" offset=\"" << appended_.size() << "\"/>\n";
        appended_.append(reinterpret_cast<const char*>(&size), sizeof(size));
        appended_.append(reinterpret_cast<const char*>(values.data()), size);
    }

    // Readers find the time by its name.
    void fieldData(const ResultSurface& surface)
    {
        text_ << "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
                 "NumberOfTuples=\"1\" format=\"ascii\">"
              << surface.time
              << "</DataArray>\n<Array type=\"String\" Name=\"generator\" "
                 "NumberOfTuples=\"1\" format=\"ascii\">";
        for (const char letter : generator())
        {
            text_ << int(letter) << ' ';
        }
        text_ << "0</Array>\n";
        if (surface.sectionNormal)
        {
            const vector& n = *surface.sectionNormal;
            text_ << "<DataArray type=\"Float64\" Name=\"sectionNormal\" "
                     "NumberOfComponents=\"3\" NumberOfTuples=\"1\" format=\"ascii\">"
                  << n.x() << ' ' << n.y() << ' ' << n.z() << "</DataArray>\n";
        }
        text_ << "</FieldData>\n";
    }

    void pointData(const ResultSurface& surface)
    {
        std::string texture;
        for (const PointArray& values : surface.arrays)
        {
            texture = isTexture(values) ? " TCoords=\"" + values.name + "\"" : texture;
        }
        text_ << "<PointData" << texture << ">\n";
        for (const PointArray& values : surface.arrays)
        {
            if (values.values.size()
                != std::size_t(surface.points.size()) * values.nComponents)
            {
                throw std::runtime_error(
                    "The array " + values.name + " has no values for each point."
                );
            }
            if (values.integer)
            {
                const std::vector<std::int32_t> whole(
                    values.values.begin(), values.values.end()
                );
                array("Int32", values.name, values.nComponents, whole);
            }
            else
            {
                array("Float64", values.name, values.nComponents, values.values);
            }
        }
        text_ << "</PointData>\n";
    }

    void points(const ResultSurface& surface)
    {
        std::vector<double> coordinates;
        for (const point& x : surface.points)
        {
            coordinates.insert(coordinates.end(), {x.x(), x.y(), x.z()});
        }
        text_ << "<Points>\n";
        array("Float64", "Points", 3, coordinates);
        text_ << "</Points>\n";
    }

    // Triangles or, where there are none, each point as a vertex.
    void cells(const ResultSurface& surface)
    {
        std::vector<std::int64_t> corners, ends;
        for (const triFace& t : surface.triangles)
        {
            corners.insert(corners.end(), {t[0], t[1], t[2]});
            ends.push_back(std::int64_t(corners.size()));
        }
        for (label i = 0; surface.triangles.empty() && i < surface.points.size(); ++i)
        {
            corners.push_back(i);
            ends.push_back(i + 1);
        }
        const std::string kind = surface.triangles.empty() ? "Verts" : "Polys";
        text_ << '<' << kind << ">\n";
        array("Int64", "connectivity", 1, corners);
        array("Int64", "offsets", 1, ends);
        text_ << "</" << kind << ">\n";
    }

    std::ostringstream text_;
    std::string appended_;
};

class OwnVtpWriter : public ResultWriter
{
public:
    void writeVtp(const std::string& path, const ResultSurface& surface) const override
    {
        replaceFile(path, VtpFile(surface).bytes());
    }

    void writePvtp(
        const std::string& path, const ResultSurface& aPiece,
        const std::vector<std::string>& pieces
    ) const override
    {
        replaceFile(path, pieceList(aPiece, pieces));
    }

    void writeTexture(const std::string& path, int size) const override
    {
        replaceFile(path, png(parameterTexture(size), size));
    }
};

class NoSurfaceReader : public SurfaceReader
{
public:
    GivenSurface read(const std::string& path) const override
    {
        throw std::runtime_error(
            "Cannot read the surface " + path
            + ": this interfaceStability was built without VTK, which reads surfaces."
        );
    }
};

} // namespace

extern "C" ResultWriter* interfaceStabilityNewVtpWriter()
{
    return new OwnVtpWriter;
}

extern "C" SurfaceReader* interfaceStabilityNewSurfaceReader()
{
    return new NoSurfaceReader;
}

} // namespace Foam::stability
