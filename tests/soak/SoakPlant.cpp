// SPDX-License-Identifier: Apache-2.0
#include "SoakPlant.h"

#include <cstring>

namespace soak {

namespace {

enum Kind { Real, ShortReal, Integer, Triple, Kinds };

Kind kindOf(int value)
{
    return Kind(value % Kinds);
}

QByteArray signalName(int node, const QByteArray &what)
{
    return "n" + QByteArray::number(node) + '.' + what;
}

QByteArray valueName(int node, int value)
{
    return signalName(node, "v" + QByteArray::number(value));
}

quint64 mixed(quint64 number)
{
    number += 0x9e3779b97f4a7c15ULL;
    number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9ULL;
    number = (number ^ (number >> 27)) * 0x94d049bb133111ebULL;
    return number ^ (number >> 31);
}

float shortReal(quint64 raw)
{
    return float(raw & 0xffffff);
}

std::array<float, 3> triple(quint64 raw)
{
    return {shortReal(raw), shortReal(raw >> 20), shortReal(raw >> 40)};
}

}  // namespace

QString nodeName(int node)
{
    return QStringLiteral("Node%1").arg(node);
}

int nodeNumber(const QString &name)
{
    bool isNumber = false;
    const int node = name.mid(4).toInt(&isNumber);
    return isNumber && name == nodeName(node) ? node : -1;
}

const char *transportOf(int node)
{
    static const char *const transports[] = {"udp", "tcp", "local"};
    return transports[node % 3];
}

namespace {

QPlcSignalTable makeTable(const PlantShape &shape)
{
    static const char *const types[Kinds] = {"Real64", "Real32", "Int32", "Real32[3]"};
    const QByteArray hold = "hold = " + QByteArray::number(shape.hold) + '\n';
    QByteArray ini = "[limit]\ntype = Real64\nsafe = " + QByteArray::number(safeLimit(quint64(shape.edition))) + '\n';
    for (int node = 0; node < shape.nodes; ++node) {
        ini += '[' + signalName(node, "life") + "]\ntype = UInt32\n" + hold;
        ini += '[' + signalName(node, "counter") + "]\ntype = UInt32\n" + hold;
        ini += '[' + signalName(node, "check") + "]\ntype = UInt64\n" + hold;
        ini += '[' + signalName(node, "drive")
            + "]\ntype = Real64\nmin = -1\nmax = 1\nsafe = " + QByteArray::number(SafeDrive) + '\n' + hold;
        for (int value = 0; value < shape.signalCount - GroupHead; ++value)
            ini += '[' + valueName(node, value) + "]\ntype = " + types[kindOf(value)] + '\n' + hold;
    }
    return QPlcSignalTable::fromIni(ini);
}

}  // namespace

QPlcSignalTable table(const PlantShape &shape)
{
    // A thread that simulates a plant asks for the same one whenever a program starts.
    thread_local PlantShape known{0, 0, 0, 0};
    thread_local QPlcSignalTable made;
    if (known.nodes != shape.nodes || known.signalCount != shape.signalCount || known.hold != shape.hold
        || known.edition != shape.edition) {
        made = makeTable(shape);
        known = shape;
    }
    return made;
}

quint64 rawValue(int node, quint32 life, quint32 counter, int index)
{
    return mixed(mixed(mixed(quint64(life) << 32 | counter) + quint64(node)) + quint64(index));
}

Check::Check(int node, quint32 life, quint32 counter)
    : m_value(mixed(mixed(quint64(life) << 32 | counter) ^ quint64(node + 1)))
{
}

void Check::add(quint64 number)
{
    m_value = mixed(m_value ^ number) + m_value;
}

void Check::add(double number)
{
    quint64 bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    add(bits);
}

quint64 checkOfNothing(const PlantShape &shape, int node, double drive)
{
    Check check(node, 0, 0);
    check.add(drive);
    const int values = shape.signalCount - GroupHead;
    int numbers = 0;
    for (int value = 0; value < values; ++value)
        numbers += kindOf(value) == Triple ? 3 : 1;
    for (int i = 0; i < numbers; ++i)
        check.add(quint64(0));  // also the bits of 0.0
    return check.value();
}

template<template<typename> class Port>
Group<Port>::Group(QPlcCompactSlaveNode *owner, const PlantShape &shape, int writer)
    : node(writer)
    , life(owner, signalName(writer, "life").constData())
    , counter(owner, signalName(writer, "counter").constData())
    , check(owner, signalName(writer, "check").constData())
    , drive(owner, signalName(writer, "drive").constData())
{
    for (int value = 0; value < shape.signalCount - GroupHead; ++value) {
        const QByteArray name = valueName(writer, value);
        switch (kindOf(value)) {
        case Real:
            reals.emplace_back(owner, name.constData());
            break;
        case ShortReal:
            shortReals.emplace_back(owner, name.constData());
            break;
        case Integer:
            integers.emplace_back(owner, name.constData());
            break;
        default:
            triples.emplace_back(owner, name.constData());
        }
    }
}

template<template<typename> class Port>
quint64 Group<Port>::computedCheck() const
{
    Check sum(node, life, counter);
    sum.add(drive.value());
    for (const auto &port : reals)
        sum.add(port.value());
    for (const auto &port : shortReals)
        sum.add(double(port.value()));
    for (const auto &port : integers)
        sum.add(quint64(qint64(port.value())));
    for (const auto &port : triples) {
        for (const float element : port.value())
            sum.add(double(element));
    }
    return sum.value();
}

template struct Group<QPlcInput>;
template struct Group<QPlcOutput>;

void write(Group<QPlcOutput> &group, quint32 life, quint32 number)
{
    int index = 0;
    const auto next = [&] { return rawValue(group.node, life, number, index++); };
    group.life = life;
    group.counter = number;
    group.drive = double(next() & 0xffff) / 65536.0;
    for (auto &port : group.reals)
        port = double(qint32(next()));
    for (auto &port : group.shortReals)
        port = shortReal(next());
    for (auto &port : group.integers)
        port = qint32(next());
    for (auto &port : group.triples)
        port = triple(next());
    group.check = group.computedCheck();
}

}  // namespace soak
