// SPDX-License-Identifier: Apache-2.0
#include "CycleThread.h"

#include "BlockedSignals.h"
#include "InterruptibleWaits.h"
#include "RealTimeSetup.h"

#include <algorithm>

namespace qplc {

namespace {

// [byte] beside the stack that is touched beforehand; glibc also takes the thread-local variables
// of all libraries from it
constexpr std::size_t StackReserve = std::size_t(1024) * 1024;

/// The attributes of the new thread. It inherits the scheduling and applies the options itself,
/// because a refused scheduling shall not keep it from running.
class Attributes
{
public:
    explicit Attributes(int prefaultStack)
    {
        pthread_attr_init(&m_attributes);
        pthread_attr_setinheritsched(&m_attributes, PTHREAD_INHERIT_SCHED);
        std::size_t size = 0;
        pthread_attr_getstacksize(&m_attributes, &size);
        pthread_attr_setstacksize(&m_attributes, std::max(size, std::size_t(prefaultStack) + StackReserve));
    }
    ~Attributes() { pthread_attr_destroy(&m_attributes); }
    Attributes(const Attributes &) = delete;
    Attributes &operator=(const Attributes &) = delete;

    const pthread_attr_t *get() const { return &m_attributes; }

private:
    pthread_attr_t m_attributes{};
};

/// The first 15 bytes of \a name that are whole characters: what the kernel keeps.
QByteArray kernelName(const QString &name)
{
    QByteArray text = name.toUtf8();
    int size = std::min(text.size(), 15);
    while (size > 0 && size < text.size() && (text.at(size) & 0xC0) == 0x80)
        --size;
    text.truncate(size);
    return text;
}

}  // namespace

CycleThread::CycleThread() = default;

CycleThread::~CycleThread()
{
    join();
}

bool CycleThread::start(const QString &name, const QPlcRealTimeOptions &options, std::function<void()> body)
{
    if (m_running)
        return setError(QStringLiteral("runs already; join() it first"));
    m_name = name;
    m_options = options;
    m_body = std::move(body);
    m_settings.clear();
    m_errorString.clear();
    const QString reason = refusal();
    if (!reason.isEmpty())
        return setError(reason);

    m_strand = Host::current().makeStrand();
    if (m_strand) {
        m_running = true;
        m_strand->start(m_name, m_body);
        return true;
    }
    m_settings = applyHeapOptions(m_options);  // of this thread: the new one allocates nothing while it runs
    m_applied = false;
    m_inherited = std::make_unique<Scheduling>(Scheduling::current());
    if (const int error = create()) {
        return setError(
            QStringLiteral(
                "pthread_create() failed: %1; 'ulimit -u' shows how many threads are allowed, 'free' the memory")
                .arg(qt_error_string(error)));
    }
    m_running = true;
    waitUntilApplied();
    return true;
}

QString CycleThread::refusal() const
{
    if (!m_body)
        return QStringLiteral("there is no body to run; give start() a function");
    return m_options.errorString();
}

int CycleThread::create()
{
    const Attributes attributes(m_options.prefaultStack);
    const BlockedSignals blocked;
    return pthread_create(&m_thread, attributes.get(), run, this);
}

bool CycleThread::setError(const QString &reason)
{
    m_errorString = QStringLiteral("cycle thread '%1': %2").arg(m_name, reason);
    return false;
}

void *CycleThread::run(void *self) noexcept
{
    auto *thread = static_cast<CycleThread *>(self);
    thread->applyOptions();
    thread->m_body();
    return nullptr;
}

void CycleThread::applyOptions()
{
    pthread_setname_np(pthread_self(), kernelName(m_name).constData());
    m_settings = applyRealTimeOptions(m_options, *m_inherited) + m_settings;
    if (m_options.idleLatency)
        m_settings += m_idleLatency.limit(*m_options.idleLatency);
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_applied = true;
    m_appliedChanged.notify_one();
}

void CycleThread::waitUntilApplied()
{
    std::unique_lock<std::mutex> lock(m_mutex);
    m_appliedChanged.wait(lock, [this] { return m_applied; });
}

void CycleThread::interrupt()
{
    if (m_strand)
        m_strand->interrupt();
    else if (m_running)
        InterruptibleWaits::interrupt(m_thread);
}

void CycleThread::joinThread()
{
    Q_ASSERT_X(pthread_equal(m_thread, pthread_self()) == 0, "CycleThread::join",
               "a thread cannot wait for its own end");
    pthread_join(m_thread, nullptr);
}

void CycleThread::join()
{
    if (!m_running)
        return;
    if (m_strand)
        m_strand->join();
    else
        joinThread();
    m_strand.reset();
    m_running = false;
    m_idleLatency.release();
    m_body = nullptr;  // what it holds is released on the owner's thread
}

}  // namespace qplc
