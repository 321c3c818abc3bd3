// SPDX-License-Identifier: Apache-2.0
#include "../common/RuntimeFolder.h"
#include "transport/LocalName.h"

#include <QtTest/QtTest>

using namespace qplc;

class tst_LocalName : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aNameIsFoundWhileItIsHeld();
    void aFolderThatOthersMayWriteIsNotTrusted();
};

void tst_LocalName::aNameIsFoundWhileItIsHeld()
{
    const RuntimeFolder runtime;
    QString error;
    LocalName name;
    QVERIFY2(name.hold(QStringLiteral("kite"), 50123, &error), qPrintable(error));
    QCOMPARE(LocalName::portOf(QStringLiteral("kite"), &error), quint16(50123));
    name.release();
    QCOMPARE(LocalName::portOf(QStringLiteral("kite"), &error), quint16(0));
    QVERIFY2(error.startsWith(QLatin1String("no master with the name 'kite' runs")), qPrintable(error));
}

void tst_LocalName::aFolderThatOthersMayWriteIsNotTrusted()
{
    const RuntimeFolder runtime;
    const QString folder = runtime.path() + QStringLiteral("/qtplc");
    QString error;
    LocalName held;
    QVERIFY(held.hold(QStringLiteral("kite"), 50123, &error));
    QVERIFY(QFile::setPermissions(folder, QFile::Permissions(0x7777)));
    QCOMPARE(LocalName::portOf(QStringLiteral("kite"), &error), quint16(0));
    LocalName other;
    QVERIFY(!other.hold(QStringLiteral("other"), 50124, &error));
    QCOMPARE(error, QStringLiteral("cannot publish the name 'other' in %1/other: Operation not permitted").arg(folder));
}

QTEST_GUILESS_MAIN(tst_LocalName)
#include "tst_LocalName.moc"
