// SPDX-License-Identifier: Apache-2.0
#include "realtime/SnapshotBuffer.h"

#include <QtCore/QByteArray>
#include <QtTest/QtTest>

#include <cstring>
#include <thread>
#include <vector>

using qplc::SnapshotBuffer;

namespace {

/// What publication \a stamp holds: each byte tells by its place and the stamp whether it belongs
/// here.
void fill(std::vector<unsigned char> &bytes, std::uint64_t stamp)
{
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<unsigned char>(stamp * 31 + i * 7);
}

}  // namespace

class tst_SnapshotBuffer : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void nothingIsReadBeforeTheFirstPublication();
    void copyEqualsTheNewestPublication_data();
    void copyEqualsTheNewestPublication();
    void bytesBehindTheSnapshotStayUntouched();
    void stampMayBeIgnored();
    void emptySnapshotCarriesItsStamp();
    void copiesAreNeverTorn_data();
    void copiesAreNeverTorn();
};

void tst_SnapshotBuffer::nothingIsReadBeforeTheFirstPublication()
{
    const SnapshotBuffer buffer(16);
    QByteArray bytes(16, 'x');
    std::uint64_t stamp = 7;
    QVERIFY(!buffer.read(bytes.data(), &stamp));
    QCOMPARE(bytes, QByteArray(16, 'x'));
    QCOMPARE(stamp, std::uint64_t(7));
}

void tst_SnapshotBuffer::copyEqualsTheNewestPublication_data()
{
    QTest::addColumn<int>("size");
    for (const int size : {1, 7, 8, 9, 55, 56, 57, 64, 1024, 65537})
        QTest::addRow("%d byte", size) << size;
}

void tst_SnapshotBuffer::copyEqualsTheNewestPublication()
{
    QFETCH(int, size);
    SnapshotBuffer buffer{std::size_t(size)};
    QCOMPARE(buffer.size(), std::size_t(size));
    std::vector<unsigned char> written(buffer.size());
    std::vector<unsigned char> copy(buffer.size());
    for (std::uint64_t stamp = 100; stamp < 105; ++stamp) {
        fill(written, stamp);
        buffer.publish(written.data(), stamp);
        for (int again = 0; again < 2; ++again) {  // reading takes nothing away
            std::uint64_t readStamp = 0;
            std::fill(copy.begin(), copy.end(), 0);
            QVERIFY(buffer.read(copy.data(), &readStamp));
            QCOMPARE(readStamp, stamp);
            QVERIFY(copy == written);
        }
    }
}

void tst_SnapshotBuffer::bytesBehindTheSnapshotStayUntouched()
{
    SnapshotBuffer buffer(5);
    buffer.publish("abcdefgh", 1);
    char bytes[8];
    std::memset(bytes, '-', sizeof bytes);
    QVERIFY(buffer.read(bytes, nullptr));
    QCOMPARE(QByteArray(bytes, 8), QByteArray("abcde---"));
}

void tst_SnapshotBuffer::stampMayBeIgnored()
{
    SnapshotBuffer buffer(1);
    buffer.publish("a", 1);
    char byte = 0;
    QVERIFY(buffer.read(&byte, nullptr));
    QCOMPARE(byte, 'a');
}

void tst_SnapshotBuffer::emptySnapshotCarriesItsStamp()
{
    SnapshotBuffer buffer(0);
    std::uint64_t stamp = 0;
    QVERIFY(!buffer.read(nullptr, &stamp));
    buffer.publish(nullptr, UINT64_MAX);
    QVERIFY(buffer.read(nullptr, &stamp));
    QCOMPARE(stamp, UINT64_MAX);
}

void tst_SnapshotBuffer::copiesAreNeverTorn_data()
{
    QTest::addColumn<int>("size");
    QTest::addColumn<int>("readers");
    QTest::newRow("one reader, 24 byte") << 24 << 1;
    QTest::newRow("one reader, 1 KiB") << 1024 << 1;
    QTest::newRow("three readers, 1021 byte") << 1021 << 3;
}

void tst_SnapshotBuffer::copiesAreNeverTorn()
{
    QFETCH(int, size);
    QFETCH(int, readers);
    constexpr std::uint64_t publications = 20'000;
    SnapshotBuffer buffer{std::size_t(size)};
    std::atomic<int> torn{0};
    std::atomic<int> backwards{0};

    std::vector<std::thread> threads;
    threads.reserve(std::size_t(readers));
    for (int reader = 0; reader < readers; ++reader) {
        threads.emplace_back([&] {
            std::vector<unsigned char> copy(buffer.size());
            std::vector<unsigned char> expected(buffer.size());
            for (std::uint64_t last = 0, stamp = 0; last < publications; last = stamp) {
                if (!buffer.read(copy.data(), &stamp))
                    continue;
                fill(expected, stamp);
                torn += copy != expected;
                backwards += stamp < last;
            }
        });
    }
    std::vector<unsigned char> bytes(buffer.size());
    for (std::uint64_t stamp = 1; stamp <= publications; ++stamp) {
        fill(bytes, stamp);
        buffer.publish(bytes.data(), stamp);
    }
    for (std::thread &thread : threads)
        thread.join();
    QCOMPARE(torn.load(), 0);
    QCOMPARE(backwards.load(), 0);
}

QTEST_APPLESS_MAIN(tst_SnapshotBuffer)
#include "tst_SnapshotBuffer.moc"
