// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcDriver.h"

#include <QtCore/QMap>

#include <functional>
#include <memory>

namespace qplc {

/// The kinds of drivers that a configuration may name.
class DriverCatalog
{
public:
    struct Kind
    {
        QString description;  // a line
        std::function<std::unique_ptr<QPlcDriver>()> make;
    };

    /// That of the process, with all kinds of this library.
    static DriverCatalog &instance();

    void add(const QString &name, const Kind &kind) { m_kinds.insert(name, kind); }
    const QMap<QString, Kind> &kinds() const { return m_kinds; }

private:
    DriverCatalog();
    QMap<QString, Kind> m_kinds;
};

}  // namespace qplc
