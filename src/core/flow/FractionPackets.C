// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/FractionPackets.H"

#include "core/cells/CellPackets.H"
#include "Map.H"

namespace Foam::stability
{

namespace
{

// The global boundary faces of these cells, and their places in the complex.
void boundaryFacesOf(
    const CellComplex& complex, const labelList& cells, DynamicList<label>& global,
    DynamicList<label>& local
)
{
    for (const label celli : cells)
    {
        for (const label facei : complex.cellFaces()[celli])
        {
            const label i = facei - complex.nInternalFaces();
            if (i >= 0 && complex.kinds()[i] != BoundaryKind::coupledUnknown)
            {
                global.append(complex.input().globalBoundaryFaces[i]);
                local.append(i);
            }
        }
    }
}

// Values by global number, of one volume fraction.
struct Fractions
{
    Map<scalar> cells, boundaryFaces;

    static scalarField inOrder(const Map<scalar>& values, const labelList& numbers)
    {
        scalarField result(numbers.size(), 0);
        forAll(numbers, i)
        {
            result[i] = values.lookup(numbers[i], 0);
        }
        return result;
    }
};

} // namespace

Packet packedFractions(const FlowSnapshot& snapshot, const labelList& cells)
{
    const CellComplex& complex = *snapshot.complex;
    DynamicList<label> global, local;
    boundaryFacesOf(complex, cells, global, local);
    Packet packet;
    pack(blockOf(complex.input(), complex.cellFaces(), cells), packet);
    packet.putList(global);
    packet.put(snapshot.alphas.size());
    forAll(snapshot.alphas, i)
    {
        packet.putList(scalarField(snapshot.alphas[i], cells));
        packet.putList(scalarField(snapshot.boundaryAlphas[i], local));
    }
    return packet;
}

std::shared_ptr<FlowSnapshot>
assembledFractions(std::vector<Packet>& packets, const CellComplex& local)
{
    std::vector<CellBlock> blocks;
    std::vector<Fractions> fractions;
    for (Packet& packet : packets)
    {
        if (packet.empty())
        {
            continue;
        }
        blocks.push_back(unpacked(packet));
        const labelList boundaryFaces(packet.getList<label>());
        fractions.resize(packet.get<label>());
        for (Fractions& values : fractions)
        {
            const List<scalar> inCells(packet.getList<scalar>());
            const List<scalar> onBoundary(packet.getList<scalar>());
            forAll(inCells, i)
            {
                values.cells.insert(blocks.back().cells[i], inCells[i]);
            }
            forAll(onBoundary, i)
            {
                values.boundaryFaces.insert(boundaryFaces[i], onBoundary[i]);
            }
        }
    }
    if (blocks.empty())
    {
        return nullptr;
    }
    CellComplexInput input(assemble(blocks, local.patchNames(), local.whole()));
    auto snapshot = std::make_shared<FlowSnapshot>();
    for (const Fractions& values : fractions)
    {
        snapshot->alphas.append(Fractions::inOrder(values.cells, input.globalCells));
        snapshot->boundaryAlphas.append(
            Fractions::inOrder(values.boundaryFaces, input.globalBoundaryFaces)
        );
    }
    snapshot->complex = std::make_shared<const CellComplex>(std::move(input));
    return snapshot;
}

} // namespace Foam::stability
