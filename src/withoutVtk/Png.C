// SPDX-License-Identifier: GPL-3.0-or-later

#include "withoutVtk/Png.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

// Four bytes, the highest first.
std::string highFirst(std::uint32_t value)
{
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
    {
        bytes += char(value >> shift & 0xff);
    }
    return bytes;
}

// The cyclic redundancy check of PNG.
std::uint32_t crc32(const std::string& bytes)
{
    std::uint32_t crc = 0xffffffff;
    for (const char byte : bytes)
    {
        crc ^= std::uint8_t(byte);
        for (int bit = 0; bit < 8; ++bit)
        {
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
        }
    }
    return ~crc;
}

// The checksum of zlib.
std::uint32_t adler32(const std::string& bytes)
{
    std::uint32_t a = 1, b = 0;
    for (const char byte : bytes)
    {
        a = (a + std::uint8_t(byte)) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

// A stream of zlib whose blocks are stored as they are.
std::string stored(const std::string& bytes)
{
    constexpr std::size_t longest = 65535;
    std::string stream = "\x78\x01";
    for (std::size_t at = 0; at < bytes.size(); at += longest)
    {
        const std::size_t n = std::min(longest, bytes.size() - at);
        stream += char(at + n == bytes.size()); // 1: the last block
        for (const std::size_t length : {n, ~n})
        {
            stream += char(length & 0xff);
            stream += char(length >> 8 & 0xff);
        }
        stream.append(bytes, at, n);
    }
    return stream + highFirst(adler32(bytes));
}

std::string chunk(const std::string& type, const std::string& data)
{
    const std::string content = type + data;
    return highFirst(std::uint32_t(data.size())) + content + highFirst(crc32(content));
}

} // namespace

std::string png(const std::vector<Colour>& pixels, int size)
{
    std::string rows;
    for (int row = size - 1; row >= 0; --row)
    {
        rows += '\0'; // no filter
        for (int column = 0; column < size; ++column)
        {
            for (const std::uint8_t value : pixels[std::size_t(row) * size + column])
            {
                rows += char(value);
            }
        }
    }
    const std::string kind("\x08\x02\0\0\0", 5); // 8 bits each of red, green and blue
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", highFirst(size) + highFirst(size) + kind)
           + chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

} // namespace Foam::stability
