// SPDX-License-Identifier: Apache-2.0
#include "Crc32c.h"

#include "TabledCrc.h"

#if defined(__x86_64__)
#include <nmmintrin.h>
#elif defined(__aarch64__) && defined(__linux__)
#include <asm/hwcap.h>
#include <sys/auxv.h>
#endif

namespace qplc {

namespace {

constexpr std::uint32_t Polynomial = 0x82F63B78;  // bits reflected
[[maybe_unused]] constexpr std::size_t Word = sizeof(std::uint64_t);

// Each step of an instruction goes on with the state of the register, which is the inverted
// checksum.

#if defined(__x86_64__)

bool hasInstruction() noexcept
{
    return __builtin_cpu_supports("sse4.2") != 0;
}

__attribute__((target("sse4.2"))) std::uint32_t byInstruction(std::uint32_t state, const char *bytes,
                                                              std::size_t size) noexcept
{
    std::uint64_t wide = state;
    for (; size >= Word; size -= Word, bytes += Word)
        wide = _mm_crc32_u64(wide, loadLittle<std::uint64_t>(bytes));
    state = std::uint32_t(wide);
    for (; size > 0; --size, ++bytes)
        state = _mm_crc32_u8(state, std::uint8_t(*bytes));
    return state;
}

#elif defined(__aarch64__) && defined(__linux__)

bool hasInstruction() noexcept
{
    static const bool has = (getauxval(AT_HWCAP) & HWCAP_CRC32) != 0;
    return has;
}

// Assembler rather than intrinsics: compilers spell the attribute that would allow those in
// different ways.
std::uint32_t byInstruction(std::uint32_t state, const char *bytes, std::size_t size) noexcept
{
    for (; size >= Word; size -= Word, bytes += Word)
        __asm__(".arch_extension crc\n\tcrc32cx %w0, %w0, %x1" : "+r"(state) : "r"(loadLittle<std::uint64_t>(bytes)));
    for (; size > 0; --size, ++bytes)
        __asm__(".arch_extension crc\n\tcrc32cb %w0, %w0, %w1"
                : "+r"(state)
                : "r"(std::uint32_t(std::uint8_t(*bytes))));
    return state;
}

#else

bool hasInstruction() noexcept
{
    return false;
}

std::uint32_t byInstruction(std::uint32_t state, const char *, std::size_t) noexcept
{
    return state;
}

#endif

}  // namespace

std::uint32_t crc32c(std::uint32_t crc, const void *bytes, std::size_t size) noexcept
{
    if (!hasInstruction())
        return crc32cByTable(crc, bytes, size);
    return ~byInstruction(~crc, static_cast<const char *>(bytes), size);
}

std::uint32_t crc32cByTable(std::uint32_t crc, const void *bytes, std::size_t size) noexcept
{
    return TabledCrc<Polynomial>::of(crc, static_cast<const char *>(bytes), size);
}

}  // namespace qplc
