// SPDX-License-Identifier: Apache-2.0
#include "CanOpenObject.h"

#include <QtCore/QRegularExpression>

#include <algorithm>

namespace qplc {

namespace {

struct TypeWord
{
    quint16 dataType;  // of CiA 301
    const char *word;
    RawNumber::Kind kind;
    int bits;
};

constexpr TypeWord typeWords[] = {
    {0x0001, "bool", RawNumber::Unsigned, 1}, {0x0002, "i8", RawNumber::Signed, 8},
    {0x0003, "i16", RawNumber::Signed, 16},   {0x0004, "i32", RawNumber::Signed, 32},
    {0x0005, "u8", RawNumber::Unsigned, 8},   {0x0006, "u16", RawNumber::Unsigned, 16},
    {0x0007, "u32", RawNumber::Unsigned, 32}, {0x0008, "f32", RawNumber::Float, 32},
    {0x0010, "i24", RawNumber::Signed, 24},   {0x0011, "f64", RawNumber::Float, 64},
    {0x0015, "i64", RawNumber::Signed, 64},   {0x0016, "u24", RawNumber::Unsigned, 24},
    {0x001B, "u64", RawNumber::Unsigned, 64},
};

struct StandardObject
{
    quint16 index;
    quint8 sub;
    const char *word;
    bool isWritable;
    const char *name;
};

constexpr StandardObject standardObjects[] = {
    {0x1000, 0, "u32", false, "DeviceType"},
    {0x1001, 0, "u8", false, "ErrorRegister"},
    {0x1005, 0, "u32", true, "CobIdSync"},
    {0x1006, 0, "u32", true, "CommunicationCyclePeriod"},
    {0x1014, 0, "u32", true, "CobIdEmergency"},
    {0x1016, 1, "u32", true, "ConsumerHeartbeatTime"},
    {0x1017, 0, "u16", true, "ProducerHeartbeatTime"},
    {0x1018, 1, "u32", false, "Identity.Vendor"},
    {0x1018, 2, "u32", false, "Identity.Product"},
    {0x1018, 3, "u32", false, "Identity.Revision"},
    {0x1018, 4, "u32", false, "Identity.Serial"},
    {0x6007, 0, "i16", true, "AbortConnectionOptionCode"},
    {0x603F, 0, "u16", false, "ErrorCode"},
    {0x6040, 0, "u16", true, "Controlword"},
    {0x6041, 0, "u16", false, "Statusword"},
    {0x605A, 0, "i16", true, "QuickStopOptionCode"},
    {0x605B, 0, "i16", true, "ShutdownOptionCode"},
    {0x605C, 0, "i16", true, "DisableOperationOptionCode"},
    {0x605D, 0, "i16", true, "HaltOptionCode"},
    {0x605E, 0, "i16", true, "FaultReactionOptionCode"},
    {0x6060, 0, "i8", true, "ModesOfOperation"},
    {0x6061, 0, "i8", false, "ModesOfOperationDisplay"},
    {0x6064, 0, "i32", false, "PositionActualValue"},
    {0x6065, 0, "u32", true, "FollowingErrorWindow"},
    {0x606C, 0, "i32", false, "VelocityActualValue"},
    {0x6071, 0, "i16", true, "TargetTorque"},
    {0x6072, 0, "u16", true, "MaxTorque"},
    {0x6075, 0, "u32", true, "MotorRatedCurrent"},
    {0x6076, 0, "u32", true, "MotorRatedTorque"},
    {0x6077, 0, "i16", false, "TorqueActualValue"},
    {0x6078, 0, "i16", false, "CurrentActualValue"},
    {0x6079, 0, "u32", false, "DcLinkCircuitVoltage"},
    {0x607A, 0, "i32", true, "TargetPosition"},
    {0x607C, 0, "i32", true, "HomeOffset"},
    {0x607D, 1, "i32", true, "SoftwarePositionLimit.Min"},
    {0x607D, 2, "i32", true, "SoftwarePositionLimit.Max"},
    {0x607F, 0, "u32", true, "MaxProfileVelocity"},
    {0x6080, 0, "u32", true, "MaxMotorSpeed"},
    {0x6081, 0, "u32", true, "ProfileVelocity"},
    {0x6083, 0, "u32", true, "ProfileAcceleration"},
    {0x6084, 0, "u32", true, "ProfileDeceleration"},
    {0x6085, 0, "u32", true, "QuickStopDeceleration"},
    {0x6087, 0, "u32", true, "TorqueSlope"},
    {0x6098, 0, "i8", true, "HomingMethod"},
    {0x6099, 1, "u32", true, "HomingSpeeds.Switch"},
    {0x6099, 2, "u32", true, "HomingSpeeds.Zero"},
    {0x609A, 0, "u32", true, "HomingAcceleration"},
    {0x60B1, 0, "i32", true, "VelocityOffset"},
    {0x60B2, 0, "i16", true, "TorqueOffset"},
    {0x60C2, 1, "u8", true, "InterpolationTimePeriod.Value"},
    {0x60C2, 2, "i8", true, "InterpolationTimePeriod.Index"},
    {0x60F4, 0, "i32", false, "FollowingErrorActualValue"},
    {0x60FD, 0, "u32", false, "DigitalInputs"},
    {0x60FE, 1, "u32", true, "DigitalOutputs.Physical"},
    {0x60FF, 0, "i32", true, "TargetVelocity"},
    {0x6502, 0, "u32", false, "SupportedDriveModes"},
};

}  // namespace

std::optional<ObjectAddress> ObjectAddress::fromText(const QString &text)
{
    static const QRegularExpression pattern(QStringLiteral("^([0-9A-Fa-f]{4}):([0-9A-Fa-f]{2})$"));
    const QRegularExpressionMatch match = pattern.match(text);
    if (!match.hasMatch())
        return std::nullopt;
    return ObjectAddress{quint16(match.captured(1).toUInt(nullptr, 16)), quint8(match.captured(2).toUInt(nullptr, 16))};
}

QString ObjectAddress::toText() const
{
    return QString::asprintf("%04X:%02X", index, sub);
}

std::optional<RawNumber> CanOpenObject::numberOfType(quint16 dataType)
{
    for (const TypeWord &type : typeWords) {
        if (type.dataType == dataType)
            return RawNumber{type.kind, type.bits};
    }
    return std::nullopt;
}

std::optional<RawNumber> CanOpenObject::numberOfWord(const QString &word)
{
    for (const TypeWord &type : typeWords) {
        if (word == QLatin1String(type.word))
            return RawNumber{type.kind, type.bits};
    }
    return std::nullopt;
}

const CanOpenDictionary &CanOpenDictionary::standard()
{
    static const CanOpenDictionary dictionary = [] {
        QVector<CanOpenObject> objects;
        for (const StandardObject &object : standardObjects)
            objects.append({{object.index, object.sub},
                            QLatin1String(object.name),
                            CanOpenObject::numberOfWord(QLatin1String(object.word)),
                            object.isWritable,
                            std::nullopt});
        return CanOpenDictionary(objects);
    }();
    return dictionary;
}

CanOpenDictionary::CanOpenDictionary(QVector<CanOpenObject> objects)
    : m_objects(std::move(objects))
{
    const auto key = [](const CanOpenObject &object) { return object.address.key(); };
    std::stable_sort(m_objects.begin(), m_objects.end(),
                     [&](const CanOpenObject &a, const CanOpenObject &b) { return key(a) < key(b); });
    const auto end = std::unique(m_objects.begin(), m_objects.end(),
                                 [&](const CanOpenObject &a, const CanOpenObject &b) { return key(a) == key(b); });
    m_objects.erase(end, m_objects.end());
}

const CanOpenObject *CanOpenDictionary::find(ObjectAddress address) const
{
    const auto found
        = std::lower_bound(m_objects.cbegin(), m_objects.cend(), address.key(),
                           [](const CanOpenObject &object, quint32 key) { return object.address.key() < key; });
    return found != m_objects.cend() && found->address == address ? &*found : nullptr;
}

const CanOpenObject *CanOpenDictionary::find(const QString &text) const
{
    if (const auto address = ObjectAddress::fromText(text))
        return find(*address);
    const auto found = std::find_if(m_objects.cbegin(), m_objects.cend(),
                                    [&](const CanOpenObject &object) { return object.name == text; });
    return found == m_objects.cend() ? nullptr : &*found;
}

QByteArray littleEndian(quint64 bits, int size)
{
    QByteArray bytes(size, '\0');
    for (int i = 0; i < size; ++i)
        bytes[i] = char(quint8(bits >> (8 * i)));
    return bytes;
}

quint64 fromLittleEndian(const QByteArray &bytes)
{
    quint64 bits = 0;
    for (int i = 0; i < std::min(bytes.size(), 8); ++i)
        bits |= quint64(quint8(bytes.at(i))) << (8 * i);
    return bits;
}

}  // namespace qplc
