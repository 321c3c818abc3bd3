// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hardware/fake/FakeMemory.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>

/// The files of devices, as the kernel shows them in /sys, in a folder of the test: `root =
/// fake:NAME`.
class SysfsTree
{
public:
    explicit SysfsTree(const QString &name)
        : m_root(name)
    {
    }

    QString path(const QString &file) const { return qplc::FakeMemory::path(m_root) + QLatin1Char('/') + file; }
    void write(const QString &file, const QByteArray &text) const
    {
        QFile target(path(file));
        if (!QDir().mkpath(QFileInfo(target).path()) || !target.open(QIODevice::WriteOnly | QIODevice::Truncate)
            || target.write(text) != text.size())
            qFatal("cannot write %s", qPrintable(target.fileName()));
    }
    QByteArray read(const QString &file) const
    {
        QFile source(path(file));
        return source.open(QIODevice::ReadOnly) ? source.readAll() : QByteArray();
    }
    /// \param target  in the tree
    void link(const QString &file, const QString &target) const
    {
        if (!QDir().mkpath(QFileInfo(path(file)).path()) || !QFile::link(path(target), path(file)))
            qFatal("cannot link %s", qPrintable(file));
    }
    bool remove(const QString &folder = QString()) const { return QDir(path(folder)).removeRecursively(); }

private:
    const QString m_root;
};
