// SPDX-License-Identifier: GPL-3.0-or-later

// A rank that runs out of memory, wherever it is then: all ranks end with an exception,
// and none waits for another one. (Under the address sanitizer, which has an allocator
// of its own, there is nothing to test here.)

#ifndef __SANITIZE_ADDRESS__

#include "core/StabilityTracker.H"

#include "shapes/ExactAlpha.H"
#include "shapes/MeshParts.H"
#include "shapes/PolyMeshes.H"
#include "shapes/ThreadRanks.H"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <new>
#include <omp.h>

namespace
{

// How many allocations of this thread still succeed; the next one fails, once. Those
// within parallel regions of OpenMP, out of which no exception may come, do not count.
constexpr long unlimited = std::numeric_limits<long>::max();
thread_local long nLeft = unlimited;

void* allocated(std::size_t size)
{
    if (nLeft != unlimited && omp_get_level() == 0 && nLeft-- == 0)
    {
        nLeft = unlimited;
        throw std::bad_alloc();
    }
    void* const memory = std::malloc(size > 0 ? size : 1);
    if (!memory)
    {
        throw std::bad_alloc();
    }
    return memory;
}

} // namespace

void* operator new(std::size_t size)
{
    return allocated(size);
}

void* operator new[](std::size_t size)
{
    return allocated(size);
}

void operator delete(void* memory) noexcept
{
    std::free(memory);
}

void operator delete[](void* memory) noexcept
{
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
    std::free(memory);
}

void operator delete[](void* memory, std::size_t) noexcept
{
    std::free(memory);
}

using namespace Foam;
using namespace Foam::stability;

namespace
{

// What transports packets does not fail.
class SafeExchange : public Exchange
{
public:
    explicit SafeExchange(const Exchange& exchange) : exchange_(exchange) {}

    label nRanks() const override { return exchange_.nRanks(); }
    label rank() const override { return exchange_.rank(); }
    std::string firstNonEmpty(const std::string& text) const override
    {
        const Pause pause;
        return exchange_.firstNonEmpty(text);
    }

private:
    std::vector<Packet> send(std::vector<Packet> toRanks) const override
    {
        const Pause pause;
        return exchange_.exchange(std::move(toRanks));
    }
    label sumOf(label value) const override
    {
        const Pause pause;
        return exchange_.total(value);
    }

    struct Pause
    {
        long before = nLeft;
        Pause() { nLeft = unlimited; }
        ~Pause() { nLeft = before; }
    };

    const Exchange& exchange_;
};

// A drop and a layer that move, on two ranks, from the start to the second time.
void analyse(const Exchange& ranks, const shapes::MeshParts& parts, label nAllocations)
{
    const SafeExchange exchange(ranks);
    const auto part = parts.part(exchange, 8);
    const auto at = [&](scalar time)
    {
        const shapes::Shape drop = shapes::unionOf(
            shapes::sphere(point(4.1 + time, 3.8, 5.2), 1.9),
            shapes::halfSpace(point(0, 0, 1.3), vector(0.1, 0, 1))
        );
        auto snapshot = std::make_shared<FlowSnapshot>(shapes::snapshotOf(part, drop));
        snapshot->U = vector(1, 0, 0);
        snapshot->boundaryU = vector(1, 0, 0);
        snapshot->time = time;
        return snapshot;
    };
    const auto first = at(0), second = at(0.4);
    TrackerOptions options;
    options.reconstruction.volumeFit = VolumeFit::component;
    options.reconstruction.sharpening = Sharpening::automatic;
    nLeft = exchange.rank() == 1 && nAllocations >= 0 ? nAllocations : unlimited;
    try
    {
        const auto work = [&]
        {
            StabilityTracker tracker(options, exchange);
            tracker.start(first);
            tracker.classify();
            tracker.advance(second);
            tracker.classify();
        };
        runOnAllRanks(exchange, work);
    }
    catch (...)
    {
        nLeft = unlimited;
        throw;
    }
    const bool spared = nLeft == unlimited;
    nLeft = unlimited;
    if (nAllocations >= 0 && exchange.rank() == 1 && !spared)
    {
        throw std::out_of_range("fewer allocations");
    }
}

} // namespace

TEST(MemoryOverRanks, noRankWaitsForOneThatRanOut)
{
    const auto complex = shapes::box(shapes::boxOf(8));
    const shapes::MeshParts parts(
        complex, shapes::slabs(*complex, 2, vector(1, 0.2, 0.1))
    );
    const char* const many = std::getenv("MEMORY_TESTS");
    const label nTests = many ? std::atoi(many) : 4;
    const label step = 9001; // some ten thousand allocations are made
    for (label i = 0; i < nTests; ++i)
    {
        const label n = 1 + (i * step) % 40009;
        try
        {
            shapes::onRanks(
                2, [&](const Exchange& ranks) { analyse(ranks, parts, n); }
            );
            ADD_FAILURE() << "nothing failed at allocation " << n;
        }
        catch (const NumericalFailure&)
        {
            // all ranks agree
        }
        catch (const std::exception& error)
        {
            ADD_FAILURE() << "allocation " << n << ": " << error.what();
        }
    }
}

#endif
