// SPDX-License-Identifier: Apache-2.0
#include "realtime/HeapReserve.h"

#include "ThreadCosts.h"
#include "realtime/CycleThread.h"

#include <QtTest/QtTest>

#include <array>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace {

constexpr std::size_t KiB = 1024;
constexpr std::size_t MiB = KiB * KiB;

/// [kB] of this process in memory, counted page by page; 0 where the kernel does not tell. Takes
/// nothing from the heap.
long residentMemory()
{
    char text[4096] = {};
    const int file = ::open("/proc/self/smaps_rollup", O_RDONLY | O_CLOEXEC);
    const ssize_t size = file < 0 ? -1 : ::read(file, text, sizeof text - 1);
    if (file >= 0)
        ::close(file);
    const char *line = size > 0 ? std::strstr(text, "\nRss:") : nullptr;
    return line ? std::strtol(line + 5, nullptr, 10) : 0;
}

/// [byte] that the heap of this thread has from the system.
std::size_t heapSize()
{
    return std::size_t(::mallinfo2().arena);
}

/// Blocks of \a sizes are taken, written to their last byte and given back, which is done \a times
/// times.
template<std::size_t N>
void useHeap(const std::array<std::size_t, N> &sizes, int times)
{
    std::array<char *, N> blocks{};
    for (int i = 0; i < times; ++i) {
        for (std::size_t k = 0; k < N; ++k) {
            blocks[k] = static_cast<char *>(std::malloc(sizes[k]));
            for (std::size_t at = 0; at < sizes[k]; ++at)
                static_cast<volatile char *>(blocks[k])[at] = char(i);
        }
        for (char *block : blocks)
            std::free(block);
    }
}

struct Spent
{
    std::uint64_t pageFaults = 0;
    long resident = 0;  // [kB]
    long heapSize = 0;  // [byte]
};

/// What useHeap() costs, when its code has run before.
template<std::size_t N>
Spent spentBy(const std::array<std::size_t, N> &sizes)
{
    useHeap(std::array<std::size_t, N>{}, 1);
    residentMemory();
    const long resident = residentMemory();
    const std::size_t size = heapSize();
    const std::uint64_t before = ThreadCosts::ofThisThread().pageFaults;
    useHeap(sizes, 20);
    Spent spent;
    spent.pageFaults = ThreadCosts::ofThisThread().pageFaults - before;
    spent.heapSize = long(heapSize()) - long(size);
    spent.resident = residentMemory() - resident;
    return spent;
}

QPlcRealTimeSetting heapOf(const QVector<QPlcRealTimeSetting> &settings)
{
    for (const QPlcRealTimeSetting &setting : settings) {
        if (setting.name == QLatin1String("heap"))
            return setting;
    }
    return {};
}

QVector<QPlcRealTimeSetting> settingsOf(const QPlcRealTimeOptions &options)
{
    qplc::CycleThread thread;
    if (!thread.start(QStringLiteral("test"), options, [] {}))
        qWarning("%s", qPrintable(thread.errorString()));
    thread.join();
    munlockall();
    return thread.settings();
}

constexpr std::array<std::size_t, 6> SmallBlocks{100, 5 * KiB, 120 * KiB, 3 * KiB, 60 * KiB, 24};
constexpr std::array<std::size_t, 1> LargeBlock{1900 * KiB};  // such a one has a mapping of its own else

}  // namespace

/// In this order: what a process has done to its heap stays.
class tst_HeapReserve : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void freedMemoryIsReturnedWithoutAReserve();
    void memoryThatIsNotLockedHasNoReserve();
    void lockedMemoryHasAReserve();
    void theReserveIsFreeAndInMemory();
    void allocationsWithinTheReserveCauseNoPageFault();
    void largeBlockWithinTheReserveCausesNoPageFault();
    void reserveIsAllocatedOnce();
    void aHeapThatMayNotGrowIsReported();
};

void tst_HeapReserve::initTestCase()
{
    if (!ThreadCosts::areCounted())
        QSKIP("the sanitizer has its own heap, and there is no reserve", "");
}

void tst_HeapReserve::freedMemoryIsReturnedWithoutAReserve()
{
    QVERIFY(spentBy(SmallBlocks).pageFaults > 20);  // or the next ones show nothing
}

void tst_HeapReserve::memoryThatIsNotLockedHasNoReserve()
{
    QPlcRealTimeOptions options;
    QCOMPARE(heapOf(settingsOf(options)).name, QString());
    options.lockMemory = true;
    options.heapReserve = 0;
    QCOMPARE(heapOf(settingsOf(options)).name, QString());
}

void tst_HeapReserve::lockedMemoryHasAReserve()
{
    QPlcRealTimeOptions options;
    options.lockMemory = true;
    options.heapReserve = 2 * int(MiB);
    const QPlcRealTimeSetting heap = heapOf(settingsOf(options));
    QCOMPARE(heap.toString(), QStringLiteral("heap: wanted 2097152 byte, obtained 2097152 byte"));
    QVERIFY(heap.granted);
}

void tst_HeapReserve::theReserveIsFreeAndInMemory()
{
    QVERIFY2(::mallinfo2().keepcost >= 2 * MiB, qPrintable(QString::number(::mallinfo2().keepcost)));
    const auto top = static_cast<char *>(::sbrk(0));
    std::array<unsigned char, 2 * MiB / (4 * KiB)> pages{};
    QCOMPARE(::mincore(top - 2 * MiB, 2 * MiB, pages.data()), 0);  // smaller pages there are none
    const std::size_t count = 2 * MiB / std::size_t(::sysconf(_SC_PAGESIZE));
    for (std::size_t i = 0; i < count; ++i)
        QVERIFY((pages[i] & 1) != 0);
}

void tst_HeapReserve::allocationsWithinTheReserveCauseNoPageFault()
{
    const Spent spent = spentBy(SmallBlocks);
    QCOMPARE(spent.pageFaults, std::uint64_t(0));
    QCOMPARE(spent.heapSize, 0L);
    QCOMPARE(spent.resident, 0L);
}

void tst_HeapReserve::largeBlockWithinTheReserveCausesNoPageFault()
{
    const Spent spent = spentBy(LargeBlock);
    QCOMPARE(spent.pageFaults, std::uint64_t(0));
    QCOMPARE(spent.heapSize, 0L);
    QCOMPARE(spent.resident, 0L);
}

void tst_HeapReserve::reserveIsAllocatedOnce()
{
    volatile char *const kept = static_cast<char *>(std::malloc(MiB));  // half of the reserve is in use
    *kept = 1;                                                          // or the compiler leaves it out
    const std::size_t before = heapSize();
    QCOMPARE(qplc::reserveHeap(2 * MiB), 2 * MiB);
    QCOMPARE(qplc::reserveHeap(MiB), MiB);
    QCOMPARE(heapSize(), before);
    QCOMPARE(qplc::reserveHeap(3 * MiB), 3 * MiB);  // who wants more gets more
    QVERIFY(heapSize() > before);
    std::free(const_cast<char *>(kept));
}

void tst_HeapReserve::aHeapThatMayNotGrowIsReported()
{
    rlimit before{};
    ::getrlimit(RLIMIT_AS, &before);
    const rlimit narrow{rlim_t(256) * MiB, before.rlim_max};
    QPlcRealTimeOptions options;
    options.lockMemory = true;
    options.heapReserve = 512 * int(MiB);
    ::setrlimit(RLIMIT_AS, &narrow);
    const std::size_t reserved = qplc::reserveHeap(std::size_t(options.heapReserve));
    const QPlcRealTimeSetting heap = heapOf(settingsOf(options));
    ::setrlimit(RLIMIT_AS, &before);
    QCOMPARE(reserved, 3 * MiB);  // that there were before
    QVERIFY(!heap.granted);
    QCOMPARE(heap.wanted, QStringLiteral("536870912 byte"));
    QCOMPARE(heap.obtained, QStringLiteral("3145728 byte"));
    QVERIFY2(heap.remedy.contains(QLatin1String("-v is 262144")), qPrintable(heap.remedy));
}

QTEST_APPLESS_MAIN(tst_HeapReserve)
#include "tst_HeapReserve.moc"
