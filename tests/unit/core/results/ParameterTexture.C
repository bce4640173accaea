// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/results/ParameterTexture.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace Foam;
using namespace Foam::stability;

namespace
{

constexpr int size = 512;

// Screen to CIELAB under D65, the other way than the code under test.
struct Lab
{
    double L, a, b;
    double chroma() const { return std::hypot(a, b); }
    double hue() const { return std::atan2(b, a) * 180 / M_PI; } // -180 to 180
};

double linear(std::uint8_t c)
{
    const double s = c / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

Lab lab(const Colour& c)
{
    const double r = linear(c[0]), g = linear(c[1]), b = linear(c[2]);
    const auto f = [](double t)
    { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
    const double x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047);
    const double y = f(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
    const double z = f((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double difference(const Colour& c, const Colour& d)
{
    const Lab p = lab(c), q = lab(d);
    return std::hypot(p.L - q.L, p.a - q.a, p.b - q.b);
}

const std::vector<Colour>& texture()
{
    static const std::vector<Colour> pixels = parameterTexture(size);
    return pixels;
}

Colour pixel(int i, int j)
{
    return texture()[std::size_t(j) * size + i];
}

bool swatch(int i, int j)
{
    return (i + 0.5) / size > 1 - Swatches::size && (j + 0.5) / size < Swatches::size;
}

// Distance of a pixel from the nearest grid line, in cells of the grid.
double offLine(int i)
{
    const double x = 16 * (i + 0.5) / size;
    return std::abs(x - std::round(x));
}

bool offLines(int i, int j)
{
    return offLine(i) > 0.1 && offLine(j) > 0.1;
}

} // namespace

TEST(ParameterTexture, HasEvenLightnessOffTheLines)
{
    ASSERT_EQ(texture().size(), std::size_t(size) * size);
    int n = 0;
    for (int j = 0; j < size; ++j)
    {
        for (int i = 0; i < size; ++i)
        {
            if (!swatch(i, j) && offLines(i, j))
            {
                ++n;
                ASSERT_NEAR(lab(pixel(i, j)).L, 74, 0.6) << i << ' ' << j;
            }
        }
    }
    EXPECT_GT(n, size * size / 2);
}

TEST(ParameterTexture, HasNeitherBlackNorRed)
{
    const double redHue = lab({255, 0, 0}).hue(); // 40 degrees
    for (int j = 0; j < size; ++j)
    {
        for (int i = 0; i < size; ++i)
        {
            if (swatch(i, j))
            {
                continue;
            }
            const Lab c = lab(pixel(i, j));
            ASSERT_GT(c.L, 45) << i << ' ' << j;
            const double turn = std::remainder(c.hue() - redHue, 360);
            ASSERT_GT(std::abs(turn), 50) << i << ' ' << j;
            ASSERT_GT(c.chroma(), 10) << i << ' ' << j; // no grey
        }
    }
}

TEST(ParameterTexture, TellsPlacesApart)
{
    // Middles of the grid's cells: no two are the same, and far ones differ by
    // several times what is just noticeable (2.3).
    std::vector<std::pair<vector2D, Colour>> cells;
    for (int k = 0; k < 256; ++k)
    {
        const vector2D p((k % 16 + 0.5) / 16, (k / 16 + 0.5) / 16);
        cells.emplace_back(p, parameterColour(p));
    }
    for (std::size_t a = 0; a < cells.size(); ++a)
    {
        for (std::size_t b = 0; b < a; ++b)
        {
            const double apart = mag(cells[a].first - cells[b].first);
            const double d = difference(cells[a].second, cells[b].second);
            ASSERT_GT(d, 0.7) << a << ' ' << b;
            if (apart > 0.5)
            {
                ASSERT_GT(d, 12) << a << ' ' << b;
            }
        }
    }
}

TEST(ParameterTexture, ColourOfAPointIsThatOfItsPixel)
{
    for (const vector2D& p :
         {vector2D(0.03, 0.97), vector2D(0.41, 0.22), vector2D(0.72, 0.53),
          vector2D(0.97, 0.72)})
    {
        const int i = int(p.x() * size), j = int(p.y() * size);
        ASSERT_TRUE(offLines(i, j));
        EXPECT_LT(difference(pixel(i, j), parameterColour(p)), 1.5) << p.x();
    }
    // v upwards: the upper left is full yellow, the lower left is pale.
    EXPECT_GT(lab(pixel(16, size - 16)).chroma(), lab(pixel(16, 16)).chroma() + 20);
}

TEST(ParameterTexture, GridLinesAreDarkerTonesOfTheSameHue)
{
    for (int k = 1; k < 16; ++k)
    {
        const int line = k * size / 16; // its left edge is the multiple of 1/16
        const Lab on = lab(pixel(line, size / 2 + 8));
        const Lab off = lab(pixel(line + 6, size / 2 + 8));
        EXPECT_LT(on.L, off.L - 15) << k;
        EXPECT_LT(std::abs(std::remainder(on.hue() - off.hue(), 360)), 8) << k;
        EXPECT_LT(lab(pixel(size / 2 + 8, line)).L, 60) << k;
    }
}

TEST(ParameterTexture, LinesStayVisibleAtSmallSizes)
{
    const int small = 128;
    const std::vector<Colour> pixels = parameterTexture(small);
    for (int k = 1; k < 16; ++k)
    {
        const Colour c = pixels[std::size_t(small / 2 + 3) * small + k * small / 16];
        EXPECT_LT(lab(c).L, 60) << k;
    }
}

TEST(ParameterTexture, SwatchesAreBlackAndBrownAndNothingElse)
{
    const auto at = [](const vector2D& p)
    { return pixel(int(p.x() * size), int(p.y() * size)); };
    EXPECT_EQ(at(Swatches::attached()), attachedColour);
    EXPECT_EQ(at(Swatches::entered()), enteredColour);
    for (int j = 0; j < size; ++j)
    {
        for (int i = 0; i < size; ++i)
        {
            const Colour c = pixel(i, j);
            ASSERT_EQ(c == attachedColour || c == enteredColour, swatch(i, j))
                << i << ' ' << j;
        }
    }
}
