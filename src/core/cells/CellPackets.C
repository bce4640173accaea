// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellPackets.H"

namespace Foam::stability
{

void pack(const CellBlock& block, Packet& packet)
{
    packet.putList(block.cells);
    packet.putList(block.nFaces);
    packet.putFaces(block.faces);
    packet.putList(block.cellBehind);
    packet.putList(block.boundaryFaces);
    packet.putList(block.kinds);
    packet.putList(block.patches);
    packet.putList(block.pointIds);
    packet.putList(block.points);
    packet.putList(block.homes);
    packet.putList(block.cellHomes);
}

Packet packed(const CellBlock& block)
{
    Packet packet;
    pack(block, packet);
    return packet;
}

CellBlock unpacked(Packet& packet)
{
    CellBlock block;
    block.cells = packet.getList<label>();
    block.nFaces = packet.getList<label>();
    block.faces = packet.getFaces();
    block.cellBehind = packet.getList<label>();
    block.boundaryFaces = packet.getList<label>();
    block.kinds = packet.getList<BoundaryKind>();
    block.patches = packet.getList<label>();
    block.pointIds = packet.getList<label>();
    block.points = packet.getList<point>();
    block.homes = packet.getList<point>();
    block.cellHomes = packet.getList<point>();
    return block;
}

} // namespace Foam::stability
