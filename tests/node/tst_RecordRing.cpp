// SPDX-License-Identifier: Apache-2.0
#include "RingFixtures.h"

#include <QtTest/QtTest>

#include <csignal>
#include <fcntl.h>
#include <random>
#include <sys/wait.h>
#include <thread>

using namespace qplc;

// Records in memory that outlives the process that writes them.
class tst_RecordRing : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aRecordIsReadAsItWasWritten();
    void theFileBelongsToItsUserAlone();
    void withoutARecorderTheNewestRecordsStay();
    void whatARecorderHasNotReleasedStays();
    void roomThatIsReservedIsLeft();
    void aSecondRecorderIsRefused();
    void aRecorderOfAFullRingLeavesRoom();
    void aRecorderGoesOnWhereOneHasEnded();
    void aReaderThatIsTooSlowIsTold();
    void aReaderBesideTheWriterNeverSeesATornRecord();
    void theRingOfAKilledWriterIsWhole();
    void whatIsNoRingIsRefused_data();
    void whatIsNoRingIsRefused();
    void aDamagedRecordEndsTheReading();
    void memoryThatIsNotThereIsAnError();
    void aRingHasItsSizeFromItsRecords();
    void theUseOfARingIsKnown();
    void textsAreReadAsTheyWereWritten();
    void withoutARecorderTheNewestTextsStay();
    void textsWithoutRoomAreCounted();
    void aTextThatIsPutBackIsReadAgain();
    void aRingWithoutTextsTakesNone();
};

namespace {

/// The number of the text that was found; 0: none was.
quint64 numberOfText(RegionReader &texts, QByteArray *text = nullptr)
{
    if (texts.next() != RegionReader::Found || texts.size() < sizeof(RecordedText))
        return 0;
    RecordedText head;
    std::memcpy(&head, texts.body(), sizeof head);
    if (text)
        *text = QByteArray(texts.body() + sizeof head, int(head.textSize));
    return head.number;
}

}  // namespace

void tst_RecordRing::aRecordIsReadAsItWasWritten()
{
    TestRing test;
    QVERIFY2(test.isThere, qPrintable(test.error));
    RingReader reader;
    QString error;
    QVERIFY2(reader.open(test.file, &error), qPrintable(error));
    QCOMPARE(reader.memory().description(), QByteArray("a description"));
    QCOMPARE(reader.next(), RingReader::Nothing);
    QVERIFY(test.write(7));
    QCOMPARE(reader.next(), RingReader::Found);
    QVERIFY(reader.kind() == RecordKind::Cycle);
    QCOMPARE(TestRing::numberOf(reader), qint64(7));
    QCOMPARE(reader.next(), RingReader::Nothing);
}

void tst_RecordRing::theFileBelongsToItsUserAlone()
{
    TestRing test;
    QCOMPARE(QFile(test.file).permissions() & ~(QFile::ReadUser | QFile::WriteUser),
             QFile::Permissions(QFile::ReadOwner | QFile::WriteOwner));
}

void tst_RecordRing::withoutARecorderTheNewestRecordsStay()
{
    TestRing test;
    constexpr qint64 count = 5000;  // ten times the ring
    for (qint64 i = 0; i < count; ++i)
        QVERIFY(test.write(quint64(i)));
    RingReader reader;
    QString error;
    QVERIFY(reader.open(test.file, &error));
    QCOMPARE(reader.next(), RingReader::Lost);
    QCOMPARE(reader.next(), RingReader::Found);
    const qint64 first = TestRing::numberOf(reader);
    quint64 bytes = TestRing::sizeOf(quint64(first));
    qint64 last = first;
    while (reader.next() == RingReader::Found) {
        QCOMPARE(TestRing::numberOf(reader), ++last);
        bytes += TestRing::sizeOf(quint64(last));
    }
    QCOMPARE(last, count - 1);
    QVERIFY(bytes <= 64 * 1024);
    QVERIFY(bytes + TestRing::sizeOf(quint64(first - 1)) > 64 * 1024);  // another one would not fit
}

void tst_RecordRing::whatARecorderHasNotReleasedStays()
{
    TestRing test;
    RingReader recorder;
    QString error;
    QVERIFY(recorder.open(test.file, &error));
    QVERIFY(recorder.attach());
    quint64 written = 0;
    while (test.write(written))
        ++written;
    QVERIFY(!test.ring->hasRoomFor(TestRing::sizeOf(written)));
    qint64 read = 0;
    for (; read < 100; ++read) {
        QCOMPARE(recorder.next(), RingReader::Found);
        QCOMPARE(TestRing::numberOf(recorder), read);
    }
    QVERIFY(!test.write(written));  // read, and not in safety
    recorder.release();
    while (test.write(written))
        ++written;
    for (; recorder.next() == RingReader::Found; ++read)
        QCOMPARE(TestRing::numberOf(recorder), read);
    QCOMPARE(quint64(read), written);
    recorder.detach();
    QVERIFY(test.write(written));  // replaces the oldest ones
}

void tst_RecordRing::roomThatIsReservedIsLeft()
{
    TestRing test(4096);
    RingReader recorder;
    QString error;
    QVERIFY(recorder.open(test.file, &error));
    QVERIFY(recorder.attach());
    while (test.ring->begin(64, 128))
        test.ring->commit(RecordKind::Cycle, 64);
    QVERIFY(test.ring->begin(128));
}

void tst_RecordRing::aSecondRecorderIsRefused()
{
    TestRing test;
    RingReader first;
    RingReader second;
    QString error;
    QVERIFY(first.open(test.file, &error));
    QVERIFY(second.open(test.file, &error));
    QVERIFY(first.attach());
    QVERIFY(!second.attach());
    first.detach();
    QVERIFY(second.attach());
}

void tst_RecordRing::aRecorderOfAFullRingLeavesRoom()
{
    TestRing test;
    for (quint64 i = 0; i < 1000; ++i)
        QVERIFY(test.write(i));
    RingReader recorder;
    QString error;
    QVERIFY(recorder.open(test.file, &error));
    QVERIFY(recorder.attach());
    QVERIFY(test.ring->hasRoomFor(64 * 1024 / 8));
    QVERIFY(!test.ring->hasRoomFor(64 * 1024 / 8 + 1024));
    qint64 last = -1;
    for (; recorder.next() == RingReader::Found; last = TestRing::numberOf(recorder))
        QVERIFY(last < 0 || TestRing::numberOf(recorder) == last + 1);
    QCOMPARE(last, qint64(999));
}

void tst_RecordRing::aRecorderGoesOnWhereOneHasEnded()
{
    TestRing test;
    QString error;
    {
        RingReader killed;  // its end is that of its process: it detaches nothing
        QVERIFY(killed.open(test.file, &error));
        QVERIFY(killed.attach());
        for (quint64 i = 0; i < 20; ++i)
            QVERIFY(test.write(i));
        for (int i = 0; i < 5; ++i)
            QCOMPARE(killed.next(), RingReader::Found);
        killed.release();
        for (int i = 0; i < 5; ++i)
            QCOMPARE(killed.next(), RingReader::Found);
    }
    quint64 written = 20;
    while (test.write(written))
        ++written;
    RingReader next;
    QVERIFY(next.open(test.file, &error));
    QVERIFY(next.attach());
    for (qint64 i = 5; i < qint64(written); ++i) {
        QCOMPARE(next.next(), RingReader::Found);
        QCOMPARE(TestRing::numberOf(next), i);
    }
    QCOMPARE(next.next(), RingReader::Nothing);
}

void tst_RecordRing::aReaderThatIsTooSlowIsTold()
{
    TestRing test;
    RingReader reader;
    QString error;
    QVERIFY(reader.open(test.file, &error));
    QVERIFY(test.write(0));
    QCOMPARE(reader.next(), RingReader::Found);
    for (quint64 i = 1; i < 3000; ++i)
        QVERIFY(test.write(i));
    QCOMPARE(reader.next(), RingReader::Lost);
    QCOMPARE(reader.next(), RingReader::Found);
    QVERIFY(TestRing::numberOf(reader) > 1);
}

void tst_RecordRing::aReaderBesideTheWriterNeverSeesATornRecord()
{
    TestRing test(4096);  // replaced all the time
    RingReader reader;
    QString error;
    QVERIFY(reader.open(test.file, &error));
    std::atomic<bool> hasEnded{false};
    std::thread writer([&] {
        for (quint64 i = 0; i < 300'000; ++i)
            test.write(i);
        hasEnded = true;
    });
    qint64 last = -1;
    bool isRight = true;
    while (isRight) {
        const bool wasOver = hasEnded;
        const RingReader::Result result = reader.next();
        isRight = result != RingReader::Damaged;
        if (result == RingReader::Found) {
            isRight = TestRing::numberOf(reader) > last;
            last = TestRing::numberOf(reader);
        }
        if (result == RingReader::Nothing && wasOver)
            break;
    }
    writer.join();
    QVERIFY(isRight);
    QCOMPARE(last, qint64(299'999));
}

/// Writes until it is killed, and tells by a pipe what is written for sure.
[[noreturn]] void writeUntilKilled(TestRing &test, int pipe)
{
    for (quint64 i = 0;; ++i) {
        if (test.write(i)) [[maybe_unused]]
            const ssize_t told = ::write(pipe, &i, sizeof i);
    }
}

void tst_RecordRing::theRingOfAKilledWriterIsWhole()
{
    std::mt19937 random(1);  // NOLINT: the same each time
    for (int run = 0; run < 20; ++run) {
        TestRing test;
        int ends[2];
        QCOMPARE(::pipe2(ends, O_CLOEXEC), 0);
        const pid_t writer = ::fork();
        if (writer == 0)
            writeUntilKilled(test, ends[1]);
        const int told = int(random() % 20'000);
        quint64 number = 0;
        for (int i = 0; i < told; ++i)
            QCOMPARE(::read(ends[0], &number, sizeof number), ssize_t(sizeof number));
        QCOMPARE(::kill(writer, SIGKILL), 0);
        QCOMPARE(::waitpid(writer, nullptr, 0), writer);
        ::close(ends[1]);
        while (::read(ends[0], &number, sizeof number) == ssize_t(sizeof number)) {}
        ::close(ends[0]);
        RingReader reader;
        QString error;
        QVERIFY(reader.open(test.file, &error));
        RingReader::Result result = reader.next();
        if (result == RingReader::Lost)
            result = reader.next();
        qint64 last = -1;
        for (; result == RingReader::Found; result = reader.next()) {
            QVERIFY(last < 0 || TestRing::numberOf(reader) == last + 1);
            last = TestRing::numberOf(reader);
        }
        QCOMPARE(result, RingReader::Nothing);
        QVERIFY(last >= qint64(number) || (number == 0 && told == 0));
    }
}

void tst_RecordRing::whatIsNoRingIsRefused_data()
{
    QTest::addColumn<int>("cutTo");
    QTest::addColumn<int>("changed");
    QTest::newRow("empty") << 0 << -1;
    QTest::newRow("cut in its header") << 100 << -1;
    QTest::newRow("cut in its records") << 5000 << -1;
    QTest::newRow("of another version") << -1 << 0;
    QTest::newRow("with another capacity") << -1 << 9;
    QTest::newRow("with records elsewhere") << -1 << 17;
    QTest::newRow("with a description beyond its end") << -1 << 23;
}

void tst_RecordRing::whatIsNoRingIsRefused()
{
    QFETCH(int, cutTo);
    QFETCH(int, changed);
    TestRing test;
    QFile file(test.file);
    QVERIFY(file.open(QIODevice::ReadWrite));
    if (cutTo >= 0)
        QVERIFY(file.resize(cutTo));
    if (changed >= 0) {
        QVERIFY(file.seek(changed));
        QCOMPARE(file.write("\x77", 1), qint64(1));
    }
    file.close();
    RingReader reader;
    QString error;
    QVERIFY(!reader.open(test.file, &error));
    QVERIFY2(error.contains("is not a ring of this version of QtPLC"), qPrintable(error));
    QCOMPARE(RingMemory::useOf(test.file), RingMemory::NoRing);
}

void tst_RecordRing::aDamagedRecordEndsTheReading()
{
    TestRing test;
    for (quint64 i = 0; i < 10; ++i)
        QVERIFY(test.write(i));
    *test.ring->memory().cycles().at(TestRing::sizeOf(0)) ^= 1;
    RingReader reader;
    QString error;
    QVERIFY(reader.open(test.file, &error));
    QCOMPARE(reader.next(), RingReader::Found);
    QCOMPARE(reader.next(), RingReader::Damaged);
    QCOMPARE(reader.next(), RingReader::Nothing);
    QVERIFY(test.write(10));
    QCOMPARE(reader.next(), RingReader::Found);
    QCOMPARE(TestRing::numberOf(reader), qint64(10));
}

void tst_RecordRing::memoryThatIsNotThereIsAnError()
{
    RecordRing ring;
    QString error;
    QVERIFY(!ring.create("/no-such-folder/ring", 4096, {}, &error));
    QVERIFY2(error.contains("/no-such-folder/ring"), qPrintable(error));
    QVERIFY(!ring.create(RingMemory::folder() + "/qtplc-test-huge", std::size_t(1) << (8 * sizeof(std::size_t) - 18),
                         {}, &error));
    QVERIFY2(error.startsWith("cannot take "), qPrintable(error));
    QVERIFY(!QFile::exists(RingMemory::folder() + "/qtplc-test-huge"));
}

void tst_RecordRing::aRingHasItsSizeFromItsRecords()
{
    const QByteArray folder = RingMemory::folder();
    QCOMPARE(RecordRing::capacityFor(1.0, 60.0, 100, folder), std::size_t(1) << 20);
    QCOMPARE(RecordRing::capacityFor(100.0, 60.0, 300, folder), std::size_t(2) << 20);
    QCOMPARE(RecordRing::capacityFor(1.0, 1.0, 1 << 20, folder), std::size_t(4) << 20);  // some records fit
    QVERIFY(RecordRing::capacityFor(1e6, 60.0, 1 << 16, folder) <= std::size_t(64) << 20);
}

void tst_RecordRing::theUseOfARingIsKnown()
{
    TestRing test;
    QString error;
    QCOMPARE(RingMemory::useOf(test.file), RingMemory::Alive);
    {
        RingReader recorder;
        QVERIFY(recorder.open(test.file, &error));
        QVERIFY(recorder.attach());
        QVERIFY(recorder.hasWriter());
        test.ring.reset();
        QVERIFY(!recorder.hasWriter());
        QCOMPARE(RingMemory::useOf(test.file), RingMemory::BeingRead);
    }
    QCOMPARE(RingMemory::useOf(test.file), RingMemory::DeadAndRecorded);
    RingReader recorder;
    QVERIFY(recorder.open(test.file, &error));
    QVERIFY(recorder.attach());
    recorder.detach();
    QCOMPARE(RingMemory::useOf(test.file), RingMemory::Dead);
}

void tst_RecordRing::textsAreReadAsTheyWereWritten()
{
    TestRing test(4096, 4096);
    QVERIFY2(test.isThere, qPrintable(test.error));
    RingReader reader;
    QString error;
    QVERIFY2(reader.open(test.file, &error), qPrintable(error));
    QCOMPARE(reader.texts().next(), RegionReader::Nothing);
    RecordedText head;
    head.cycle = 7;
    head.topic = RecordedText::Lease;
    test.ring->addText(head, "{\"a\":1}");
    test.ring->addText(head, "");
    test.ring->endTexts();
    QByteArray text;
    QCOMPARE(numberOfText(reader.texts(), &text), quint64(1));
    QCOMPARE(text, QByteArray("{\"a\":1}"));
    QVERIFY(reader.texts().kind() == RecordKind::Text);
    QCOMPARE(numberOfText(reader.texts(), &text), quint64(2));
    QCOMPARE(text, QByteArray());
    QCOMPARE(numberOfText(reader.texts()), quint64(3));
    QVERIFY(reader.texts().kind() == RecordKind::LastText);
    QCOMPARE(reader.next(), RingReader::Nothing);  // the cycles have a region of their own
}

void tst_RecordRing::withoutARecorderTheNewestTextsStay()
{
    TestRing test(4096, 4096);
    for (int i = 0; i < 1000; ++i)
        test.ring->addText({}, QByteArray(i % 100, 'x'));
    RingReader reader;
    QString error;
    QVERIFY(reader.open(test.file, &error));
    QCOMPARE(reader.texts().next(), RegionReader::Lost);
    quint64 last = 0;
    int count = 0;
    for (quint64 number = numberOfText(reader.texts()); number != 0; number = numberOfText(reader.texts()), ++count) {
        QVERIFY(last == 0 || number == last + 1);
        last = number;
    }
    QCOMPARE(last, quint64(1000));
    QVERIFY(count > 20);
}

void tst_RecordRing::textsWithoutRoomAreCounted()
{
    TestRing test(4096, 4096);
    RingReader recorder;
    QString error;
    QVERIFY(recorder.open(test.file, &error));
    QVERIFY(recorder.attach());
    constexpr quint64 told = 500;
    for (quint64 i = 0; i < told; ++i)
        test.ring->addText({}, QByteArray(100, 'x'));
    test.ring->addText({}, QByteArray(4096, 'x'));  // would replace all others
    test.ring->leaveOutText();
    test.ring->endTexts();  // has room
    quint64 last = 0;
    quint64 count = 0;
    for (quint64 number = numberOfText(recorder.texts()); number != 0; number = numberOfText(recorder.texts())) {
        ++count;
        QVERIFY(number == last + 1 || recorder.texts().kind() == RecordKind::LastText);
        last = number;
    }
    QVERIFY(count < told);
    QCOMPARE(last, told + 3);
    recorder.release();
    test.ring->addText({}, QByteArray(100, 'x'));
    QCOMPARE(numberOfText(recorder.texts()), told + 4);
}

void tst_RecordRing::aTextThatIsPutBackIsReadAgain()
{
    TestRing test(4096, 4096);
    RingReader recorder;
    QString error;
    QVERIFY(recorder.open(test.file, &error));
    QVERIFY(recorder.attach());
    test.ring->addText({}, "{}");
    QCOMPARE(numberOfText(recorder.texts()), quint64(1));
    recorder.texts().putBack();
    recorder.release();  // keeps it
    QCOMPARE(numberOfText(recorder.texts()), quint64(1));
    QCOMPARE(recorder.texts().next(), RegionReader::Nothing);
}

void tst_RecordRing::aRingWithoutTextsTakesNone()
{
    TestRing test;
    test.ring->addText({}, "{}");
    test.ring->endTexts();
    RingReader recorder;
    QString error;
    QVERIFY(recorder.open(test.file, &error));
    QVERIFY(recorder.attach());
    QVERIFY(recorder.texts().isEmpty());
    QCOMPARE(recorder.texts().next(), RegionReader::Nothing);
    recorder.release();
    recorder.detach();
}

QTEST_GUILESS_MAIN(tst_RecordRing)
#include "tst_RecordRing.moc"
