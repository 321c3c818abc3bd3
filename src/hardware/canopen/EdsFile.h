// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CanOpenObject.h"
#include "QPlcParseError.h"

#include <QtCore/QHash>

namespace qplc {

/// What the electronic data sheet (EDS) of a CANopen device, or its configured form (DCF), says of
/// the objects of the device: CiA 306.
///
/// Read are the sections of objects with ParameterName, DataType, AccessType, DefaultValue and
/// ParameterValue (which is stronger), CompactSubObj, `$NODEID` in values, and the identity in
/// [DeviceInfo]. Everything else is skipped. Upper and lower case are the same. The text is UTF-8,
/// else Latin-1.
class EdsFile
{
public:
    static constexpr int MaximumSize = 8 << 20;  // [byte]
    static constexpr int MaximumObjects = 20000;
    static constexpr int MaximumErrors = 20;  // that are told

    /// \param node  the `$NODEID` \param fileName  for errors
    /// \return empty when there are \a errors
    static EdsFile fromText(const QByteArray &text, const QString &fileName, int node, QVector<QPlcParseError> *errors);
    /// As above; a file that cannot be read is an error of line 0.
    static EdsFile fromFile(const QString &fileName, int node, QVector<QPlcParseError> *errors);

    const CanOpenDictionary &dictionary() const { return m_dictionary; }
    /// Of the vendor; 0: the file does not say it.
    quint32 vendor() const { return m_vendor; }
    quint32 product() const { return m_product; }

private:
    CanOpenDictionary m_dictionary;
    quint32 m_vendor = 0;
    quint32 m_product = 0;
};

}  // namespace qplc
