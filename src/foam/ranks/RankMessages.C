// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/ranks/RankMessages.H"

#include "PstreamBuffers.H"
#include "PstreamReduceOps.H"
#include "UIPstream.H"
#include "UOPstream.H"

namespace Foam::stability
{

RankMessages::RankMessages()
    : communicator_(
        UPstream::parRun() ? UPstream::allocateCommunicator(
            UPstream::worldComm, identity(UPstream::nProcs(UPstream::worldComm))
        )
                           : UPstream::worldComm
    )
{
}

RankMessages::~RankMessages()
{
    if (communicator_ != UPstream::worldComm)
    {
        UPstream::freeCommunicator(communicator_);
    }
}

label RankMessages::nRanks() const
{
    return UPstream::parRun() ? UPstream::nProcs(communicator_) : 1;
}

label RankMessages::rank() const
{
    return UPstream::parRun() ? UPstream::myProcNo(communicator_) : 0;
}

globalIndex RankMessages::numbersOf(label size) const
{
    meet();
    return globalIndex(size);
}

std::vector<Packet> RankMessages::send(std::vector<Packet> toRanks) const
{
    std::vector<Packet> fromRanks(nRanks());
    fromRanks[rank()] = std::move(toRanks[rank()]);
    if (nRanks() == 1)
    {
        return fromRanks;
    }
    PstreamBuffers buffers(
        UPstream::commsTypes::nonBlocking, UPstream::msgType(), communicator_
    );
    for (label ranki = 0; ranki < nRanks(); ++ranki)
    {
        if (ranki != rank() && !toRanks[ranki].empty())
        {
            const UList<char>& bytes = toRanks[ranki].bytes();
            UOPstream stream(ranki, buffers);
            stream << bytes;
            ++nMessages_;
            nBytes_ += bytes.size();
        }
    }
    labelList sizes;
    buffers.finishedSends(sizes);
    for (label ranki = 0; ranki < nRanks(); ++ranki)
    {
        if (ranki != rank() && sizes[ranki] > 0)
        {
            UIPstream stream(ranki, buffers);
            fromRanks[ranki] = Packet(List<char>(stream));
        }
    }
    return fromRanks;
}

label RankMessages::sumOf(label value) const
{
    reduce(value, sumOp<label>(), UPstream::msgType(), communicator_);
    return value;
}

// Two rounds: where nothing failed, one number is all that is sent.
std::string RankMessages::firstNonEmpty(const std::string& failure) const
{
    label first = failure.empty() ? labelMax : rank();
    reduce(first, minOp<label>(), UPstream::msgType(), communicator_);
    if (first == labelMax)
    {
        return std::string();
    }
    Packet packet;
    if (rank() == first)
    {
        packet.putString(failure);
    }
    std::vector<Packet> toRanks(nRanks(), packet);
    return send(std::move(toRanks))[first].getString();
}

} // namespace Foam::stability
