// SPDX-License-Identifier: Apache-2.0
#include "../FakeDevices.h"

#include <QtTest/QtTest>

#include <sys/wait.h>
#include <unistd.h>

using qplc::FakeMemory;

class tst_FakeMemory : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aDeviceIsAFileOfItsSize();
    void processesShareTheBytesOfADevice();
    void theFileItselfCanBeWritten();
    void aDeviceThatIsMissingIsNamed();
    void aDeviceOfAnotherSizeIsRefused();
    void removedOrReplacedDeviceIsReportedAsMissing();
    void deviceNamesCannotLeaveTheFolder();
};

void tst_FakeMemory::aDeviceIsAFileOfItsSize()
{
    const FakeDevices devices;
    FakeMemory memory;
    QString error;
    QVERIFY2(memory.create("fake:board", 8, &error), qPrintable(error));
    QCOMPARE(QFileInfo(devices.path("board")).size(), qint64(8));
    QCOMPARE(QDir(FakeMemory::folder()).entryList(QDir::Files), QStringList{"board"});
    QCOMPARE(memory.size(), std::size_t(8));
    QCOMPARE(memory.at(7).load(), quint8(0));
}

void tst_FakeMemory::processesShareTheBytesOfADevice()
{
    const FakeDevices devices;
    FakeMemory memory;
    QString error;
    QVERIFY2(memory.create("fake:board", 2, &error), qPrintable(error));
    memory.at(0) = 7;
    const pid_t child = ::fork();
    if (child == 0) {
        FakeMemory same;
        const bool isThere = same.open("fake:board", 2, &error) && same.at(0) == 7;
        if (isThere)
            same.at(1) = 9;
        ::_exit(isThere ? 0 : 1);
    }
    int status = -1;
    QCOMPARE(::waitpid(child, &status, 0), child);
    QCOMPARE(status, 0);
    QCOMPARE(memory.at(1).load(), quint8(9));
}

void tst_FakeMemory::theFileItselfCanBeWritten()
{
    const FakeDevices devices;
    FakeMemory memory;
    QString error;
    QVERIFY2(memory.create("fake:board", 4, &error), qPrintable(error));
    QFile file(devices.path("board"));
    QVERIFY(file.open(QIODevice::ReadWrite));
    QVERIFY(file.seek(3));
    QCOMPARE(file.write("\x05", 1), qint64(1));
    file.close();
    QCOMPARE(memory.at(3).load(), quint8(5));
}

void tst_FakeMemory::aDeviceThatIsMissingIsNamed()
{
    const FakeDevices devices;
    FakeMemory memory;
    QString error;
    QVERIFY(!memory.open("fake:board", 0, &error));
    QVERIFY2(error.contains("no fake device 'fake:board'") && error.contains(devices.path("board"))
                 && error.contains("QTPLC_FAKE_DEVICES"),
             qPrintable(error));
    QVERIFY(!memory.isOpen());
    QVERIFY(!memory.isThere());
}

void tst_FakeMemory::aDeviceOfAnotherSizeIsRefused()
{
    const FakeDevices devices;
    FakeMemory memory;
    FakeMemory other;
    QString error;
    QVERIFY2(memory.create("fake:board", 8, &error), qPrintable(error));
    QVERIFY(!other.open("fake:board", 9, &error));
    QVERIFY2(error.contains("has 8 bytes, and not 9"), qPrintable(error));
    QVERIFY2(other.open("fake:board", 0, &error), qPrintable(error));
    QCOMPARE(other.size(), std::size_t(8));
}

void tst_FakeMemory::removedOrReplacedDeviceIsReportedAsMissing()
{
    const FakeDevices devices;
    FakeMemory player;
    FakeMemory memory;
    QString error;
    QVERIFY2(player.create("fake:board", 1, &error) && memory.open("fake:board", 1, &error), qPrintable(error));
    QVERIFY(memory.isThere());
    QVERIFY2(player.create("fake:board", 1, &error), qPrintable(error));
    QVERIFY(!memory.isThere());
    QVERIFY2(memory.open("fake:board", 1, &error), qPrintable(error));
    QVERIFY(memory.isThere());
    FakeMemory::remove("fake:board");
    QVERIFY(!memory.isThere());
    memory.at(0) = 1;  // still ours
}

void tst_FakeMemory::deviceNamesCannotLeaveTheFolder()
{
    const FakeDevices devices;
    QCOMPARE(FakeMemory::path("fake:../etc/passwd"), devices.path(".._etc_passwd"));
    QVERIFY(FakeMemory::isFake("fake:x"));
    QVERIFY(!FakeMemory::isFake("/dev/fake:x"));
}

QTEST_GUILESS_MAIN(tst_FakeMemory)
#include "tst_FakeMemory.moc"
