// SPDX-License-Identifier: Apache-2.0
#include "realtime/SpscRing.h"

#include <QtTest/QtTest>

#include <cstdint>
#include <deque>
#include <random>
#include <thread>

using qplc::SpscRing;

namespace {

struct Message
{
    std::uint64_t number;
    std::uint64_t words[6];
    std::uint64_t check;
};

Message message(std::uint64_t number)
{
    Message result{number, {}, number};
    for (std::uint64_t &word : result.words)
        result.check ^= word = (number + std::uint64_t(&word - result.words)) * 0x9E3779B97F4A7C15U;
    return result;
}

bool isWhole(const Message &message)
{
    std::uint64_t check = message.number;
    for (const std::uint64_t word : message.words)
        check ^= word;
    return check == message.check;
}

}  // namespace

class tst_SpscRing : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void capacityIsRoundedUpToAPowerOfTwo_data();
    void capacityIsRoundedUpToAPowerOfTwo();
    void emptyRingGivesNothing();
    void fullRingRefusesAndOverwritesNothing();
    void pushWithReserveIsRefusedEarlier();
    void valuesKeepTheirOrderAfterWrapAround();
    void valueIsVisibleOnlyAfterCommit();
    void frontStaysUntilItIsPopped();
    void ringBehavesLikeABoundedQueue();
    void nothingIsLostOrTornBetweenTwoThreads_data();
    void nothingIsLostOrTornBetweenTwoThreads();
    void refusedAndConsumedValuesAddUp();
};

void tst_SpscRing::capacityIsRoundedUpToAPowerOfTwo_data()
{
    QTest::addColumn<int>("wanted");
    QTest::addColumn<int>("obtained");
    QTest::newRow("0") << 0 << 1;
    QTest::newRow("1") << 1 << 1;
    QTest::newRow("2") << 2 << 2;
    QTest::newRow("3") << 3 << 4;
    QTest::newRow("64") << 64 << 64;
    QTest::newRow("65") << 65 << 128;
}

void tst_SpscRing::capacityIsRoundedUpToAPowerOfTwo()
{
    QFETCH(int, wanted);
    QFETCH(int, obtained);
    SpscRing<int> ring{std::size_t(wanted)};
    QCOMPARE(ring.capacity(), std::size_t(obtained));
    for (int i = 0; i < obtained; ++i)
        QVERIFY(ring.push(i));
    QVERIFY(!ring.push(-1));
}

void tst_SpscRing::emptyRingGivesNothing()
{
    SpscRing<int> ring(4);
    int value = 42;
    QVERIFY(!ring.front());
    QVERIFY(!ring.pop(&value));
    QCOMPARE(value, 42);
}

void tst_SpscRing::pushWithReserveIsRefusedEarlier()
{
    SpscRing<int> ring(8);
    int pushed = 0;
    while (ring.push(pushed, 3))
        ++pushed;
    QCOMPARE(pushed, 5);
    int value = 0;
    QVERIFY(ring.pop(&value));
    QVERIFY(ring.push(pushed++, 3));
    QVERIFY(!ring.push(pushed, 3));
    while (ring.push(pushed))
        ++pushed;
    QCOMPARE(pushed, 9);  // 8 are there, 1 was taken
}

void tst_SpscRing::fullRingRefusesAndOverwritesNothing()
{
    SpscRing<int> ring(2);
    QVERIFY(ring.push(1));
    QVERIFY(ring.push(2));
    QVERIFY(!ring.push(3));
    QVERIFY(!ring.beginPush());
    int value = 0;
    QVERIFY(ring.pop(&value));
    QCOMPARE(value, 1);
    QVERIFY(ring.push(4));  // one place is free again
    QVERIFY(!ring.push(5));
    QVERIFY(ring.pop(&value));
    QCOMPARE(value, 2);
    QVERIFY(ring.pop(&value));
    QCOMPARE(value, 4);
    QVERIFY(!ring.pop(&value));
}

void tst_SpscRing::valuesKeepTheirOrderAfterWrapAround()
{
    SpscRing<int> ring(8);
    int written = 0;
    int read = 0;
    for (int round = 0; round < 100; ++round) {
        for (int i = 0; i < 5; ++i)
            QVERIFY(ring.push(written++));
        for (int i = 0, value = 0; i < 5; ++i) {
            QVERIFY(ring.pop(&value));
            QCOMPARE(value, read++);
        }
    }
}

void tst_SpscRing::valueIsVisibleOnlyAfterCommit()
{
    SpscRing<Message> ring(2);
    Message *place = ring.beginPush();
    QVERIFY(place);
    *place = message(1);
    QVERIFY(!ring.front());
    QCOMPARE(ring.beginPush(), place);  // not given yet: the same place again
    ring.commitPush();
    QVERIFY(ring.front());
    QCOMPARE(ring.front()->number, std::uint64_t(1));
}

void tst_SpscRing::frontStaysUntilItIsPopped()
{
    SpscRing<int> ring(2);
    ring.push(1);
    ring.push(2);
    QCOMPARE(*ring.front(), 1);
    QCOMPARE(*ring.front(), 1);
    ring.pop();
    QCOMPARE(*ring.front(), 2);
    ring.pop();
    QVERIFY(!ring.front());
}

void tst_SpscRing::ringBehavesLikeABoundedQueue()
{
    std::mt19937 random(11);
    SpscRing<std::uint32_t> ring(16);
    std::deque<std::uint32_t> queue;
    for (int i = 0; i < 100000; ++i) {
        const auto number = std::uint32_t(random());
        if (number & 0x100) {
            const bool pushed = ring.push(number);
            QCOMPARE(pushed, queue.size() < 16);
            if (pushed)
                queue.push_back(number);
        } else {
            std::uint32_t value = 0;
            QCOMPARE(ring.pop(&value), !queue.empty());
            if (!queue.empty()) {
                QCOMPARE(value, queue.front());
                queue.pop_front();
            }
        }
    }
}

void tst_SpscRing::nothingIsLostOrTornBetweenTwoThreads_data()
{
    QTest::addColumn<int>("capacity");
    QTest::newRow("one place") << 1;
    QTest::newRow("two") << 2;
    QTest::newRow("many") << 1024;
}

void tst_SpscRing::nothingIsLostOrTornBetweenTwoThreads()
{
    QFETCH(int, capacity);
    const std::uint64_t count = capacity > 2 ? 200'000 : 20'000;
    SpscRing<Message> ring{std::size_t(capacity)};
    std::thread producer([&ring, count] {
        for (std::uint64_t number = 0; number < count; ++number) {
            const Message next = message(number);
            while (!ring.push(next))
                std::this_thread::yield();
        }
    });
    std::uint64_t wrong = 0;
    for (std::uint64_t number = 0; number < count; ++number) {
        Message received{};
        while (!ring.pop(&received))
            std::this_thread::yield();
        wrong += received.number != number || !isWhole(received);
    }
    producer.join();
    QCOMPARE(wrong, std::uint64_t(0));
    QVERIFY(!ring.front());
}

void tst_SpscRing::refusedAndConsumedValuesAddUp()
{
    constexpr std::uint64_t count = 100'000;
    SpscRing<std::uint64_t> ring(8);
    std::atomic<bool> done{false};
    std::uint64_t refused = 0;
    std::thread producer([&] {  // a cycle thread: never waits, counts what it could not say
        for (std::uint64_t number = 1; number <= count; ++number)
            refused += !ring.push(number);
        done = true;
    });
    std::uint64_t taken = 0;
    std::uint64_t last = 0;
    bool ordered = true;
    for (bool ended = false; !ended;) {
        ended = done;  // before the last look
        for (std::uint64_t number = 0; ring.pop(&number); last = number, ++taken)
            ordered = ordered && number > last;
        std::this_thread::yield();
    }
    producer.join();
    QVERIFY(ordered);
    QVERIFY(taken >= 8);
    QCOMPARE(taken + refused, count);
}

QTEST_APPLESS_MAIN(tst_SpscRing)
#include "tst_SpscRing.moc"
