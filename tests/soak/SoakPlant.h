// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

#include <array>
#include <deque>

/// A plant in which every wrong, mixed or old value can be proven.
///
/// Its nodes stand in a ring: node i reads all that node i - 1 writes. What a node writes is a
/// group: who wrote it (node, life), a counter, a drive (what the reader moves), values that follow
/// from these, and a check over all of them. A life is one process of a node: one that is started
/// again has a new, higher number.
namespace soak {

struct PlantShape
{
    int nodes = 12;
    int signalCount = 100;  // that each node writes, 5 at least
    int hold = 3;           // [cycles] that a drive is held when its writer is silent
    int edition = 0;        // of the safety parameters
};

constexpr double SafeDrive = -1.0;  // a drive that runs is 0 ... 1
/// The safe value of the signal "limit", which all nodes read and no node writes.
constexpr double safeLimit(quint64 edition)
{
    return 1.0 + double(edition);
}
constexpr int GroupHead = 4;  // signals in front of the values: life, counter, check, drive

QString nodeName(int node);
/// -1: no such node.
int nodeNumber(const QString &name);
QPlcSignalTable table(const PlantShape &shape);

/// How a node is connected: "udp", "tcp" or "local".
const char *transportOf(int node);
/// Without a critical node the plant stops safely.
inline bool isCritical(int node)
{
    return node % 4 == 3;
}
/// Every eighth node gets its table from the master.
inline bool hasOwnTable(int node)
{
    return node % 8 != 0;
}
inline bool isOnStream(int node)
{
    return node % 3 == 1;
}

/// What a node writes in one step.
struct Stamp
{
    quint32 life = 0;  // 0: nobody has written the group yet
    quint32 counter = 0;
    quint64 check = 0;

    /// Whether \a this was written after \a other, by the same node.
    bool isNewerThan(const Stamp &other) const
    {
        return life != other.life ? life > other.life : counter > other.counter;
    }
    bool operator==(const Stamp &other) const
    {
        return life == other.life && counter == other.counter && check == other.check;
    }
};

/// The check of a group that nobody has written: all values 0, the drive \a drive.
quint64 checkOfNothing(const PlantShape &shape, int node, double drive);
/// What node \a node writes as value \a index, before it is cut to the type of the signal.
quint64 rawValue(int node, quint32 life, quint32 counter, int index);

/// Over the numbers of a group, in order; has nothing in common with the checksum of the frames.
class Check
{
public:
    Check(int node, quint32 life, quint32 counter);
    void add(quint64 number);
    void add(double number);
    quint64 value() const { return m_value; }

private:
    quint64 m_value;
};

/// The ports of a group.
template<template<typename> class Port>
struct Group
{
    using Triple = std::array<float, 3>;

    Group(QPlcCompactSlaveNode *owner, const PlantShape &shape, int writer);
    /// Over the values that the ports hold.
    quint64 computedCheck() const;
    Stamp stamp() const { return {life, counter, check}; }

    int node;
    Port<quint32> life;
    Port<quint32> counter;
    Port<quint64> check;
    Port<double> drive;
    std::deque<Port<double>> reals;
    std::deque<Port<float>> shortReals;
    std::deque<Port<qint32>> integers;
    std::deque<Port<Triple>> triples;
};

/// Writes the group of step \a number of a life.
void write(Group<QPlcOutput> &group, quint32 life, quint32 number);

}  // namespace soak
