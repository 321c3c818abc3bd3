// SPDX-License-Identifier: Apache-2.0
#include "IioBuffer.h"

#include "signals/MessageText.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace qplc {

namespace {

constexpr char timestampName[] = "in_timestamp";
constexpr char clockFile[] = "current_timestamp_clock";
constexpr char triggerFile[] = "trigger/current_trigger";

/// A whole number of a file that is not negative, or \a fallback.
int integer(const QByteArray &text, int fallback)
{
    bool isNumber = false;
    const int number = text.trimmed().toInt(&isNumber);
    return isNumber && number >= 0 ? number : fallback;
}

/// For the end of a message.
QString choiceOf(const QStringList &triggers)
{
    return triggers.isEmpty() ? QStringLiteral("; the kernel has none: make one, for example with its module "
                                               "iio-trig-hrtimer (see docs/hardware/sysfs.md)")
                              : knownAre(triggers);
}

}  // namespace

IioBuffer::~IioBuffer()
{
    close();
}

// ---- set up ----

bool IioBuffer::open(const QString &root, const SysfsFolder *device, const Settings &settings)
{
    close();
    m_root = root;
    m_settings = settings;
    m_device = device;
    // Kernels from 5.13 on show several buffers; the first one is the old one.
    m_elementFolder = device->has("scan_elements") ? "scan_elements/" : "buffer0/";
    m_bufferFolder = device->has("buffer") ? "buffer/" : "buffer0/";
    m_file = m_enable = m_bufferFolder + "enable";
    if (!device->has(m_enable))
        return failWith(QStringLiteral("it has no buffer: its driver in the kernel, or the kernel, does not support "
                                       "one; leave 'buffer' out"));
    const QString devices = root == QLatin1String("/sys") ? QStringLiteral("/dev/") : root + QStringLiteral("/dev/");
    // The kernel gives this file to one program at a time. So a buffer that is on now belongs to a
    // program that has ended.
    if (openNode(devices + QFileInfo(device->path()).fileName()) && write(m_enable, "0") && findElements())
        return true;
    const int errorNumber = errno;
    close();
    errno = errorNumber;
    return false;
}

bool IioBuffer::openNode(const QString &path)
{
    m_problem.clear();
    m_file = m_nodePath = QFile::encodeName(path);
    m_node = ::open(m_nodePath.constData(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    struct stat status = {};
    if (m_node >= 0 && ::fstat(m_node, &status) == 0 && (S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode)))
        return true;
    if (m_node < 0)
        return errno == ENOENT
            ? failWith(QStringLiteral("there is no such file; the kernel makes it together with the folder of the "
                                      "device (if it is played: 'mkfifo %1')")
                           .arg(path))
            : false;
    ::close(m_node);
    m_node = -1;
    return failWith(QStringLiteral("it is not a character device; look at 'root'"));
}

bool IioBuffer::findElements()
{
    m_elements.clear();
    m_wanted.clear();
    SysfsFolder folder;
    if (!folder.open(m_device->path() + QLatin1Char('/') + QString::fromUtf8(m_elementFolder)))
        return false;
    for (const QByteArray &file : folder.files(QStringLiteral("in_*_en"))) {
        QByteArray text;
        if (!readFile(m_elementFolder + file, &text))
            return false;
        Element element;
        element.name = file.left(file.size() - 3);
        element.wasEnabled = text.trimmed() == "1";
        m_elements.push_back(element);
    }
    return true;
}

QStringList IioBuffer::channels() const
{
    QStringList names;
    for (const Element &element : m_elements) {
        if (element.name != timestampName)
            names << QString::fromUtf8(element.name.mid(3));
    }
    return names;
}

bool IioBuffer::add(const QByteArray &channel, int *number)
{
    const auto found = std::find_if(m_elements.begin(), m_elements.end(), [&](const Element &element) {
        return element.name == "in_" + channel && element.name != timestampName;
    });
    if (found == m_elements.end())
        return false;
    found->isWanted = true;
    *number = int(m_wanted.size());
    m_wanted.push_back(std::size_t(found - m_elements.begin()));
    return true;
}

bool IioBuffer::start(qint64 now)
{
    m_started = now;
    if (!setTrigger() || !setElements() || !setLength() || !layOut() || !enable())
        return false;
    // What a device that is played has sent before; the kernel has emptied its buffer.
    for (int left = 64; left > 0 && ::read(m_node, m_bytes.data(), m_bytes.size()) > 0; --left) {}
    return true;
}

bool IioBuffer::setTrigger()
{
    QByteArray text;
    const QByteArray name = m_settings.trigger.toUtf8();
    if (name.isEmpty())
        return true;
    m_file = triggerFile;
    if (!m_device->has(triggerFile))
        return failWith(QStringLiteral("it takes no trigger; leave 'trigger' out"));
    const QStringList known = triggers();
    // The kernel takes any name, and has no trigger then.
    if (!known.contains(m_settings.trigger))
        return failWith(QStringLiteral("there is no trigger %1%2").arg(quoted(m_settings.trigger), choiceOf(known)));
    if (!change(triggerFile, name) && errno != EINVAL)
        return false;
    if (readFile(triggerFile, &text) && text.trimmed() == name)
        return true;
    return failWith(QStringLiteral("the device does not take the trigger %1; write another one%2")
                        .arg(quoted(m_settings.trigger), choiceOf(known)));
}

/// Some chips cannot have all channels in one scan: those that nobody reads are switched off first.
bool IioBuffer::setElements()
{
    for (const Element &element : m_elements) {
        if (!element.isWanted && element.wasEnabled && !change(m_elementFolder + element.name + "_en", "0"))
            return false;
    }
    for (const Element &element : m_elements) {
        if (!element.isWanted || change(m_elementFolder + element.name + "_en", "1"))
            continue;
        return errno == EINVAL
            ? failWith(QStringLiteral("the chip cannot have it in one scan with the other channels; read fewer"))
            : false;
    }
    if (useTimestamp())
        change(m_elementFolder + timestampName + "_en", "1");
    return true;
}

/// \return whether the kernel has timestamps of CLOCK_MONOTONIC
bool IioBuffer::useTimestamp()
{
    QByteArray text;
    return m_device->has(m_elementFolder + timestampName + "_en") && change(clockFile, "monotonic")
        && readFile(clockFile, &text) && text.trimmed() == "monotonic";
}

/// A buffer of fixed length keeps it.
bool IioBuffer::setLength()
{
    const QByteArray file = m_bufferFolder + "length";
    QByteArray text;
    change(file, QByteArray::number(m_settings.length));
    if (readFile(file, &text))
        m_settings.length = qBound(ShortestLength, integer(text, m_settings.length), LongestLength);
    return true;
}

bool IioBuffer::layOut()
{
    m_scan.clear();
    m_timestamp = -1;
    for (Element &element : m_elements) {
        QByteArray state;
        element.place = -1;
        if (!readFile(m_elementFolder + element.name + "_en", &state))
            return false;
        if (state.trimmed() == "1" && !addPlace(&element))
            return false;
        if (element.isWanted && element.place < 0)
            return failWith(QStringLiteral("the chip does not put it into a scan with the other channels; read fewer"));
    }
    m_file = m_elementFolder;
    if (const char *problem = m_scan.layOut())
        return failWith(QLatin1String(problem));
    m_channels.clear();
    for (const std::size_t wanted : m_wanted)
        m_channels.push_back(m_elements[wanted].place);
    m_bytes.assign(std::size_t(m_scan.size()) * std::size_t(m_settings.length), 0);
    m_newest = nullptr;
    return true;
}

bool IioBuffer::addPlace(Element *element)
{
    QByteArray index;
    QByteArray type;
    if (!readFile(m_elementFolder + element->name + "_index", &index))
        return false;
    const int number = integer(index, -1);
    if (number < 0 || number >= IioScan::Last)
        return failWith(QStringLiteral("it is not a whole number; look for a newer driver of the kernel"));
    if (!readFile(m_elementFolder + element->name + "_type", &type))
        return false;
    const std::optional<IioElement> stored = IioElement::fromText(type);
    if (!stored)
        return failWith(QStringLiteral("%1 is not a type of IIO, such as 'le:s12/16>>4'; look for a newer driver of "
                                       "the kernel")
                            .arg(quoted(QString::fromUtf8(type.trimmed()))));
    const bool isTimestamp = element->name == timestampName;
    if (element->isWanted && stored->repetition > 1)
        return failWith(QStringLiteral("it has %1 values in a scan, and a channel has one; read another channel")
                            .arg(stored->repetition));
    element->place = m_scan.add(isTimestamp ? IioScan::Last : number, *stored);
    if (isTimestamp && stored->number.kind == RawNumber::Signed && stored->number.bits == 64)
        m_timestamp = element->place;
    return true;
}

bool IioBuffer::enable()
{
    QByteArray trigger;
    if (write(m_enable, "1"))
        return true;
    if (errno != EINVAL)
        return false;
    if (m_device->has(triggerFile) && m_device->read(triggerFile, &trigger) && trigger.trimmed().isEmpty())
        return failWith(QStringLiteral("it needs a trigger: write 'trigger = NAME'%1").arg(choiceOf(triggers())));
    return failWith(QStringLiteral("the chip refuses these channels or this trigger; read fewer, or name another "
                                   "trigger"));
}

void IioBuffer::close()
{
    if (m_node < 0)
        return;
    // The device may be gone: then there is nothing to set back.
    m_device->write(m_enable, "0");
    for (auto last = m_changes.crbegin(); last != m_changes.crend(); ++last)
        m_device->write(last->file, last->before);
    m_changes.clear();
    ::close(m_node);
    m_node = -1;
}

// ---- read ----

IioBuffer::Result IioBuffer::read()
{
    m_file = m_nodePath;
    m_problem.clear();
    const auto size = std::size_t(m_scan.size());
    std::size_t taken = 0;
    do {
        // The first scan is read alone: if the kernel has scans of another size, this shows it.
        const ssize_t count = take(m_newest ? m_bytes.size() - taken : size);
        if (count == 0)
            return taken > 0 ? Scan : None;
        // EINVAL: a scan of the kernel is longer than what it was asked for.
        if (count > 0 ? std::size_t(count) % size != 0 : errno == EINVAL) {
            failWith(QStringLiteral("its scans do not have the size that the kernel tells (%1 bytes); use a kernel "
                                    "from 5.7 on, and let nothing else read the device")
                         .arg(size));
            return Torn;
        }
        if (count < 0)
            return Failed;
        taken += std::size_t(count);
        m_newest = m_bytes.data() + (std::size_t(count) - size);
    } while (taken < m_bytes.size());
    failWith(QStringLiteral("more than %1 scans came in one interval, and the kernel drops the newest ones; write a "
                            "longer 'length' or a shorter 'interval'")
                 .arg(m_settings.length));
    return Full;
}

/// \return the bytes that have come, 0 if there are none; -1, with errno
ssize_t IioBuffer::take(std::size_t most)
{
    ssize_t count = 0;
    do
        count = ::read(m_node, m_bytes.data(), most);
    while (count < 0 && errno == EINTR);
    if (count > 0 || (count < 0 && errno != EAGAIN))
        return count;
    if (m_device->has(m_enable))
        return 0;
    errno = ENODEV;
    return -1;
}

qint64 IioBuffer::time(qint64 now) const noexcept
{
    if (m_timestamp < 0)
        return now;
    // Some drivers leave the timestamp empty with some triggers.
    const qint64 time = m_scan.integer(m_timestamp, m_newest);
    return time >= m_started && time <= now ? time : now;
}

// ---- files ----

bool IioBuffer::readFile(const QByteArray &file, QByteArray *text)
{
    m_file = file;
    m_problem.clear();
    return m_device->read(file, text);
}

bool IioBuffer::write(const QByteArray &file, const QByteArray &text)
{
    m_file = file;
    m_problem.clear();
    return m_device->write(file, text);
}

bool IioBuffer::change(const QByteArray &file, const QByteArray &text)
{
    QByteArray before;
    if (!readFile(file, &before))
        return false;
    if (before.trimmed() == text)
        return true;
    if (!write(file, text))
        return false;
    m_changes.push_back({file, before.trimmed() + '\n'});
    return true;
}

bool IioBuffer::failWith(const QString &problem)
{
    m_problem = problem;
    errno = EBADMSG;
    return false;
}

QStringList IioBuffer::triggers() const
{
    QStringList names;
    const QString all = m_root + QStringLiteral("/bus/iio/devices/");
    for (const QString &entry :
         QDir(all).entryList({QStringLiteral("trigger*")}, QDir::Dirs | QDir::NoDotAndDotDot, QDir::Name)) {
        SysfsFolder trigger;
        QByteArray name;
        if (trigger.open(all + entry) && trigger.read("name", &name))
            names << QString::fromUtf8(name.trimmed());
    }
    return names;
}

}  // namespace qplc
