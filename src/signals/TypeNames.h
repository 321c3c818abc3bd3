// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcSignalType.h"

#include <QtCore/QString>

namespace qplc {

/// Names of the types of many signals: in a row they often have the same one, so the last name is
/// kept.
class TypeNames
{
public:
    /// \pre \a type is valid
    const QString &of(QPlcSignalType type)
    {
        if (type != m_type) {
            m_type = type;
            m_name = type.name();
        }
        return m_name;
    }

private:
    QPlcSignalType m_type;
    QString m_name;
};

}  // namespace qplc
