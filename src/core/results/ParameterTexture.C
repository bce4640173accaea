// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/results/ParameterTexture.H"
#include "mathematicalConstants.H"

#include <algorithm>
#include <cmath>

namespace Foam::stability
{

namespace
{

using constant::mathematical::pi;

// CIELAB under D65. One lightness everywhere, so that what looks dark in a picture
// is shading, and black and red stay free for attached and detached.
constexpr scalar lightness = 74;
constexpr scalar lineLightness = 52;

// u runs through the hues from yellow over green, cyan, and blue to violet; the
// red third of the circle is left out. v runs from pale to full colour.
constexpr scalar firstHue = 98; // [degrees]
constexpr scalar lastHue = 318; // [degrees]
constexpr scalar paleChroma = 14;
constexpr scalar fullChroma = 58; // where the gamut allows

constexpr scalar nCells = 16;
constexpr scalar lineWidth = 1.0 / 18; // of a cell of the grid, at least two pixels

struct Lab
{
    scalar lightness, chroma, hue; // hue in degrees
};

// Inverse of the cube root law of CIE 1976.
scalar stimulus(scalar f)
{
    constexpr scalar d = 6.0 / 29;
    return f > d ? f * f * f : 3 * d * d * (f - 4.0 / 29);
}

// Linear sRGB; outside [0, 1] if the screen cannot show the colour.
std::array<scalar, 3> linearRgb(const Lab& c)
{
    const scalar f = (c.lightness + 16) / 116;
    const scalar a = c.chroma * std::cos(c.hue * pi / 180);
    const scalar b = c.chroma * std::sin(c.hue * pi / 180);
    const scalar x = 0.95047 * stimulus(f + a / 500);
    const scalar y = stimulus(f);
    const scalar z = 1.08883 * stimulus(f - b / 200);
    return {
        3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
        -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
        0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

bool showable(const Lab& c)
{
    const auto rgb = linearRgb(c);
    return std::all_of(
        rgb.begin(), rgb.end(), [](scalar x) { return x >= 0 && x <= 1; }
    );
}

// The fullest chroma at this hue that the screen shows, by bisection.
scalar largestChroma(scalar lightness, scalar hue)
{
    scalar inside = 0, outside = fullChroma;
    if (showable({lightness, outside, hue}))
    {
        return outside;
    }
    for (int i = 0; i < 20; ++i)
    {
        const scalar middle = 0.5 * (inside + outside);
        (showable({lightness, middle, hue}) ? inside : outside) = middle;
    }
    return inside;
}

std::uint8_t encoded(scalar linear)
{
    const scalar x = std::clamp(linear, scalar(0), scalar(1));
    const scalar s = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return std::uint8_t(std::lround(255 * s));
}

Colour screenColour(const Lab& c)
{
    const auto rgb = linearRgb(c);
    return {encoded(rgb[0]), encoded(rgb[1]), encoded(rgb[2])};
}

scalar hueOf(scalar u)
{
    return firstHue + (lastHue - firstHue) * u;
}

// The colour of the gradient, or of a grid line in it, of the same hue.
Lab shade(const vector2D& p, scalar full, scalar lightness)
{
    const scalar chroma = paleChroma + (full - paleChroma) * p.y();
    return {lightness, chroma, hueOf(p.x())};
}

// True if the pixel's middle is nearer to a multiple of 1/16 than half a line's width.
bool onLine(int pixel, int size)
{
    const scalar x = nCells * (pixel + 0.5) / size;
    const scalar halfWidth = std::max(0.5 * lineWidth, nCells / size);
    return std::abs(x - std::round(x)) < halfWidth;
}

bool liesOnSwatches(const vector2D& p)
{
    return p.x() > 1 - Swatches::size && p.y() < Swatches::size;
}

// The values that depend on u only; they are found once for each column.
struct Column
{
    scalar fullChroma;
    scalar fullLineChroma;
};

} // namespace

Colour parameterColour(const vector2D& p)
{
    const vector2D q(
        std::clamp(p.x(), scalar(0), scalar(1)), std::clamp(p.y(), scalar(0), scalar(1))
    );
    return screenColour(shade(q, largestChroma(lightness, hueOf(q.x())), lightness));
}

std::vector<Colour> parameterTexture(int size)
{
    std::vector<Column> columns(size);
    for (int i = 0; i < size; ++i)
    {
        const scalar hue = hueOf((i + 0.5) / size);
        columns[i] = {largestChroma(lightness, hue), largestChroma(lineLightness, hue)};
    }

    std::vector<Colour> pixels(std::size_t(size) * size);
    for (int j = 0; j < size; ++j)
    {
        for (int i = 0; i < size; ++i)
        {
            const vector2D p((i + 0.5) / size, (j + 0.5) / size);
            Colour& pixel = pixels[std::size_t(j) * size + i];
            if (liesOnSwatches(p))
            {
                pixel = 2 * p.y() < Swatches::size ? attachedColour : enteredColour;
            }
            else if (onLine(i, size) || onLine(j, size))
            {
                pixel =
                    screenColour(shade(p, columns[i].fullLineChroma, lineLightness));
            }
            else
            {
                pixel = screenColour(shade(p, columns[i].fullChroma, lightness));
            }
        }
    }
    return pixels;
}

} // namespace Foam::stability
