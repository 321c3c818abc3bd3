// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/RawNumber.h"

#include <QtCore/QByteArray>
#include <QtCore/QString>
#include <QtCore/QVector>

#include <optional>

namespace qplc {

/// Where an object lies in the dictionary of a device, as text `6041:00`: index and subindex, both
/// hexadecimal.
struct ObjectAddress
{
    quint16 index = 0;
    quint8 sub = 0;

    /// \return nothing when \a text is no address
    static std::optional<ObjectAddress> fromText(const QString &text);
    QString toText() const;
    /// The order of a dictionary.
    quint32 key() const { return quint32(index) << 8 | sub; }
    bool operator==(const ObjectAddress &other) const { return key() == other.key(); }
    bool operator!=(const ObjectAddress &other) const { return key() != other.key(); }
};

/// An object of a device: what its EDS file says of it, or the standard.
struct CanOpenObject
{
    ObjectAddress address;
    QString name;                     // of channels: letters and digits, a dot before that of a subindex
    std::optional<RawNumber> number;  // nothing: a text, a domain
    bool isWritable = true;
    std::optional<quint64> value;  // bits, from a file: that of a DCF file, else the default one

    /// Returns the number of a data type of CiA 301, or no value if the type is not a number.
    static std::optional<RawNumber> numberOfType(quint16 dataType);
    /// `u16`, `i32`, `f32`, `bool`: as in a configuration. Nothing: there is no such word.
    static std::optional<RawNumber> numberOfWord(const QString &word);
};

/// The objects of a device, in the order of their addresses.
class CanOpenDictionary
{
public:
    /// The objects of CiA 301 and CiA 402 that a configuration may name without a file.
    static const CanOpenDictionary &standard();

    CanOpenDictionary() = default;
    /// \param objects  in any order; of two with one address, the first one counts
    explicit CanOpenDictionary(QVector<CanOpenObject> objects);

    const QVector<CanOpenObject> &objects() const { return m_objects; }
    /// Null when there is none.
    const CanOpenObject *find(ObjectAddress address) const;
    /// By address or name.
    const CanOpenObject *find(const QString &text) const;

private:
    QVector<CanOpenObject> m_objects;
};

/// The low bytes of \a bits, least significant first, as objects travel.
QByteArray littleEndian(quint64 bits, int size);
/// The number in at most 8 bytes.
quint64 fromLittleEndian(const QByteArray &bytes);

}  // namespace qplc
