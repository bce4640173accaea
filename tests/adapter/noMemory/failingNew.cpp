// SPDX-License-Identifier: GPL-3.0-or-later

// A library to preload: operator new fails at the FAIL_AT-th large request of the
// analysis, and at all later ones of it, on rank FAIL_RANK of a parallel run. The
// analysis is what runs while there is no handler for lack of memory: OpenFOAM has one
// of its own from its start on.

#include <cstdlib>
#include <new>

namespace
{

constexpr std::size_t large = 4096; // [bytes]
bool started = false;
long count = 0;

long numberOf(const char* variable, long otherwise)
{
    const char* text = std::getenv(variable);
    return text ? std::atol(text) : otherwise;
}

bool isToFail(std::size_t size)
{
    started = started || std::get_new_handler();
    if (!started || std::get_new_handler() || size < large)
    {
        return false;
    }
    static const long failAt = numberOf("FAIL_AT", 0);
    static const bool here = numberOf("FAIL_RANK", 0) == numberOf("OMPI_COMM_WORLD_RANK", 0);
    return here && failAt > 0 && __sync_add_and_fetch(&count, 1) >= failAt;
}

} // namespace

void* operator new(std::size_t size)
{
    for (;;)
    {
        void* memory = isToFail(size) ? nullptr : std::malloc(size ? size : 1);
        if (memory)
        {
            return memory;
        }
        const std::new_handler handler = std::get_new_handler();
        if (!handler)
        {
            throw std::bad_alloc();
        }
        handler();
    }
}

void* operator new[](std::size_t size)
{
    return operator new(size);
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
