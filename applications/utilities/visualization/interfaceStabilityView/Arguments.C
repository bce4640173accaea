// SPDX-License-Identifier: GPL-3.0-or-later

#include "Arguments.H"

#include "core/base/Version.H"

#include <vtksys/CommandLineArguments.hxx>

#include <charconv>
#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace Foam::stability
{

namespace
{

// The texts of the options, before they are understood.
struct Texts
{
    std::string caseFolder, index, time, size, camera, opacity, particleSize;
};

using Parser = vtksys::CommandLineArguments;

void addOptions(Parser& parser, Arguments& arguments, Texts& texts)
{
    const auto value = Parser::SPACE_ARGUMENT;
    const auto flag = Parser::NO_ARGUMENT;
    parser.AddArgument(
        "-batch", flag, &arguments.batch, "write pictures and end, without a window"
    );
    parser.AddArgument(
        "-case", value, &texts.caseFolder, "the case or result folder (default: here)"
    );
    parser.AddArgument(
        "-methods", value, &arguments.methods,
        "draw this table methods.dat as methods.png beside it, and nothing else"
    );
    parser.AddArgument("-index", value, &texts.index, "indices as in the file names");
    parser.AddArgument("-time", value, &texts.time, "times [s]");
    parser.AddArgument("-all", flag, &arguments.all, "all times (default: the latest)");
    parser.AddArgument(
        "-output", value, &arguments.output,
        "folder for the pictures (default: pictures, beside the results)"
    );
    parser.AddArgument(
        "-size", value, &texts.size, "width and height in pixels (default: 1280x960)"
    );
    parser.AddArgument(
        "-camera", value, &texts.camera,
        "azimuth,elevation[,zoom]: degrees around the "
        "upward axis and above the horizon (default: 30,22,1, in two dimensions 0,0,1: "
        "face-on)"
    );
    parser.AddArgument(
        "-up", value, &arguments.up,
        "x, y, z, -x, -y or -z (default: against constant/g)"
    );
    parser.AddArgument(
        "-opacity", value, &texts.opacity,
        "of the surface, 0.05 to 1 (default: 0.85, in two dimensions 1)"
    );
    parser.AddArgument(
        "-particleSize", value, &texts.particleSize,
        "radius in diagonals of the domain (default: 0.004)"
    );
    parser.AddArgument("-help", flag, &arguments.help, "this text");
}

[[noreturn]] void
wrong(const std::string& option, const std::string& text, const std::string& expected)
{
    throw std::runtime_error(
        "The option " + option + " expects " + expected + ", not '" + text + "'."
    );
}

template<class Number>
std::vector<Number> numbers(
    const std::string& option, std::string text, char separator, std::string expected
)
{
    std::vector<Number> result;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, separator);)
    {
        Number number{};
        const char* end = part.data() + part.size();
        const auto [stop, error] = std::from_chars(part.data(), end, number);
        if (error != std::errc() || stop != end)
        {
            wrong(option, text, expected);
        }
        result.push_back(number);
    }
    return result;
}

double numberBetween(
    const std::string& option, const std::string& text, double least, double most,
    const std::string& expected
)
{
    const auto values = numbers<double>(option, text, ',', expected);
    if (values.size() != 1 || !(values[0] >= least && values[0] <= most))
    {
        wrong(option, text, expected);
    }
    return values[0];
}

void readSize(Arguments& arguments, const std::string& text)
{
    const std::string expected = "WIDTHxHEIGHT between 320x240 and 8192x8192";
    const auto values = numbers<int>("-size", text, 'x', expected);
    if (values.size() != 2 || values[0] < 320 || values[1] < 240 || values[0] > 8192
        || values[1] > 8192)
    {
        wrong("-size", text, expected);
    }
    arguments.size = {values[0], values[1]};
}

void readCamera(Arguments& arguments, const std::string& text)
{
    const std::string expected =
        "azimuth,elevation[,zoom] with elevation from -90 to 90 and zoom above 0";
    const auto values = numbers<double>("-camera", text, ',', expected);
    if (values.size() < 2 || values.size() > 3 || !std::isfinite(values[0])
        || !(std::abs(values[1]) <= 90)
        || (values.size() == 3 && !(values[2] > 0 && std::isfinite(values[2]))))
    {
        wrong("-camera", text, expected);
    }
    arguments.azimuth = values[0];
    arguments.elevation = values[1];
    arguments.zoom = values.size() == 3 ? values[2] : 1;
}

void understand(Arguments& arguments, const Texts& texts)
{
    arguments.indices =
        numbers<int>("-index", texts.index, ',', "whole numbers separated by commas");
    arguments.times =
        numbers<double>("-time", texts.time, ',', "numbers separated by commas");
    if (!texts.size.empty())
    {
        readSize(arguments, texts.size);
    }
    if (!texts.camera.empty())
    {
        readCamera(arguments, texts.camera);
    }
    if (!texts.opacity.empty())
    {
        arguments.opacity = numberBetween(
            "-opacity", texts.opacity, 0.05, 1, "a number from 0.05 to 1"
        );
    }
    if (!texts.particleSize.empty())
    {
        arguments.particleSize = numberBetween(
            "-particleSize", texts.particleSize, 1e-5, 0.1, "a number from 1e-5 to 0.1"
        );
    }
    const std::string& up = arguments.up;
    const std::string axis = up.size() == 2 && up[0] == '-' ? up.substr(1) : up;
    if (!up.empty() && axis != "x" && axis != "y" && axis != "z")
    {
        wrong("-up", up, "x, y, z, -x, -y or -z");
    }
}

// The argument that is not an option is the folder; there is at most one.
void readFolder(Arguments& arguments, Parser& parser, const std::string& caseFolder)
{
    int count = 0;
    char** unused = nullptr;
    parser.GetUnusedArguments(&count, &unused);
    std::vector<std::string> folders(unused + 1, unused + count);
    parser.DeleteRemainingArguments(count, &unused);
    if (!caseFolder.empty())
    {
        folders.push_back(caseFolder);
    }
    for (const std::string& folder : folders)
    {
        if (folder[0] == '-')
        {
            throw std::runtime_error("Unknown option " + folder + "; see -help.");
        }
    }
    if (folders.size() > 1)
    {
        throw std::runtime_error(
            "One case or result folder at a time, not " + folders[0] + " and "
            + folders[1] + "."
        );
    }
    if (!folders.empty())
    {
        arguments.folder = folders[0];
    }
}

} // namespace

Arguments parseArguments(int argc, char* argv[])
{
    Arguments arguments;
    Texts texts;
    Parser parser;
    parser.Initialize(argc, argv);
    parser.StoreUnusedArguments(true);
    addOptions(parser, arguments, texts);
    if (!parser.Parse())
    {
        throw std::runtime_error("An option lacks its value; see -help.");
    }
    readFolder(arguments, parser, texts.caseFolder);
    understand(arguments, texts);
    return arguments;
}

std::string helpText()
{
    Arguments arguments;
    Texts texts;
    Parser parser;
    char name[] = "interfaceStabilityView";
    char* argv[] = {name};
    parser.Initialize(1, argv);
    addOptions(parser, arguments, texts);
    return "interfaceStabilityView of " + generator()
           + "\n\n"
             "Usage: interfaceStabilityView -batch [OPTIONS] [FOLDER]\n\n"
             "Pictures of the interface with its carried parametrization, of what\n"
             "is attached (black) and of the detached particles (red). FOLDER is a\n"
             "case with results in postProcessing/interfaceStability, or a folder\n"
             "with results. Needs no display.\n\nOptions:\n"
           + parser.GetHelp();
}

} // namespace Foam::stability
