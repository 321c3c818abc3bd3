// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/fake/FakeMemory.h"

#include <QtCore/QTemporaryDir>

/// While it lives, fake devices are those of this test alone.
class FakeDevices
{
public:
    FakeDevices() { qputenv("QTPLC_FAKE_DEVICES", m_folder.path().toLocal8Bit()); }
    ~FakeDevices() { qunsetenv("QTPLC_FAKE_DEVICES"); }

    QString path(const QString &name) const { return m_folder.filePath(name); }

private:
    const QTemporaryDir m_folder;
};
