// SPDX-License-Identifier: Apache-2.0
#include "DatagramFilter.h"

#include <QtCore/qendian.h>

#include <array>
#include <cstddef>
#include <linux/if_ether.h>
#include <map>
#include <netinet/in.h>
#include <netinet/ip.h>
#include <netinet/ip6.h>
#include <set>

namespace qplc::datagramFilter {

namespace {

using Words = std::array<std::uint32_t, 4>;  // of an IPv6 address; of an IPv4 address the last one
using Ports = std::set<std::uint16_t>;

constexpr auto networkHeader = std::uint32_t(SKF_NET_OFF);
constexpr auto etherType = std::uint32_t(SKF_AD_OFF + SKF_AD_PROTOCOL);

struct Peers
{
    std::map<Words, Ports> ofIpv4;
    std::map<Words, Ports> ofIpv6;
};

void add(Program *program, std::uint16_t code, std::uint32_t number)
{
    program->push_back({code, 0, 0, number});
}

/// Skips the next \a count instructions unless the accumulator is \a value.
void skipUnless(Program *program, std::uint32_t value, std::size_t count)
{
    if (count <= 255) {
        program->push_back({BPF_JMP | BPF_JEQ | BPF_K, 0, std::uint8_t(count), value});
        return;
    }
    program->push_back({BPF_JMP | BPF_JEQ | BPF_K, 1, 0, value});
    add(program, BPF_JMP | BPF_JA, std::uint32_t(count));
}

void append(Program *program, const Program &others)
{
    program->insert(program->end(), others.begin(), others.end());
}

Peers sorted(const std::vector<SocketAddress> &peers)
{
    Peers result;
    for (const SocketAddress &peer : peers) {
        const SocketAddress mapped = peer.mappedToIpv6();
        if (mapped.family() != AF_INET6)
            continue;
        const in6_addr &address = reinterpret_cast<const sockaddr_in6 *>(&mapped.storage)->sin6_addr;
        Words words{};
        for (std::size_t i = 0; i < words.size(); ++i)
            words[i] = qFromBigEndian<quint32>(&address.s6_addr[4 * i]);
        const bool isIpv4 = IN6_IS_ADDR_V4MAPPED(&address);
        if (isIpv4)
            words = {0, 0, 0, words[3]};
        (isIpv4 ? result.ofIpv4 : result.ofIpv6)[words].insert(mapped.port());
    }
    return result;
}

/// Ends with the decision; the index register is the length of the network header.
Program decisionByPorts(const Ports &ports)
{
    Program program;
    add(&program, BPF_LD | BPF_H | BPF_IND, networkHeader);  // UDP begins with the port of the sender
    for (const std::uint16_t port : ports) {
        skipUnless(&program, port, 1);
        add(&program, BPF_RET | BPF_K, ofPeers);
    }
    add(&program, BPF_RET | BPF_K, ofStrangers);
    return program;
}

/// Ends with the decision, or goes on behind itself if the sender has another address.
/// \param first  word that is compared; \param place of word 0 in the network header
Program decisionOf(const Words &words, std::size_t first, std::uint32_t place, const Ports &ports)
{
    Program program = decisionByPorts(ports);
    for (std::size_t i = words.size(); i > first; --i) {
        Program comparison;
        add(&comparison, BPF_LD | BPF_W | BPF_ABS, networkHeader + place + std::uint32_t(4 * (i - 1 - first)));
        skipUnless(&comparison, words[i - 1], program.size());
        append(&comparison, program);
        program = comparison;
    }
    return program;
}

/// Ends with the decision for IPv4, whose header has a length of its own.
Program decisionForIpv4(const Program &rest)
{
    Program program;
    add(&program, BPF_LD | BPF_B | BPF_ABS, networkHeader);
    add(&program, BPF_ALU | BPF_AND | BPF_K, 0xf);
    add(&program, BPF_ALU | BPF_LSH | BPF_K, 2);
    add(&program, BPF_MISC | BPF_TAX, 0);
    append(&program, rest);
    add(&program, BPF_RET | BPF_K, ofStrangers);
    return program;
}

/// Headers between those of IPv6 and UDP are not looked through: no node sends them.
Program decisionForIpv6(const Program &rest)
{
    Program program;
    add(&program, BPF_LD | BPF_B | BPF_ABS, networkHeader + offsetof(ip6_hdr, ip6_nxt));
    skipUnless(&program, IPPROTO_UDP, rest.size() + 1);
    add(&program, BPF_LDX | BPF_IMM, sizeof(ip6_hdr));
    append(&program, rest);
    add(&program, BPF_RET | BPF_K, ofStrangers);
    return program;
}

Program whole(const Program &ofIpv4, const Program &ofIpv6)
{
    const Program forIpv4 = decisionForIpv4(ofIpv4);
    Program program;
    add(&program, BPF_LD | BPF_H | BPF_ABS, etherType);
    skipUnless(&program, ETH_P_IP, forIpv4.size());
    append(&program, forIpv4);
    append(&program, decisionForIpv6(ofIpv6));
    return program;
}

}  // namespace

Program byAddress(const std::vector<SocketAddress> &peers)
{
    const Peers all = sorted(peers);
    Program ofIpv4;
    for (const auto &[words, ports] : all.ofIpv4)
        append(&ofIpv4, decisionOf(words, 3, offsetof(iphdr, saddr), ports));
    Program ofIpv6;
    for (const auto &[words, ports] : all.ofIpv6)
        append(&ofIpv6, decisionOf(words, 0, offsetof(ip6_hdr, ip6_src), ports));
    return whole(ofIpv4, ofIpv6);
}

Program byPort(const std::vector<SocketAddress> &peers)
{
    Ports ports;
    for (const SocketAddress &peer : peers)
        ports.insert(peer.port());
    const Program decision = decisionByPorts(ports);
    return whole(decision, decision);
}

}  // namespace qplc::datagramFilter
