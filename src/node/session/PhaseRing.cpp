// SPDX-License-Identifier: Apache-2.0
#include "PhaseRing.h"

#include "node/cycle/NodeRegistry.h"
#include "realtime/Host.h"
#include "realtime/TimeSource.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>

#include <unistd.h>
#include <utility>

namespace qplc {

namespace {

constexpr double SecondsToKeep = 60.0;
constexpr std::size_t TextCapacity = std::size_t(1) << 20;  // [byte]
constexpr int MostDeadOnes = 4;                             // of masters that were killed: a recorder will drain them

QString prefix()
{
    return QStringLiteral("qtplc-ring-%1-").arg(::getuid());
}

QString fileName(const QString &plant, quint64 session, quint64 phase)
{
    QString name = plant.left(64);
    for (QChar &sign : name) {
        if (!sign.isLetterOrNumber() || sign.unicode() > 127)
            sign = QLatin1Char('_');
    }
    return prefix() + QStringLiteral("%1-%2-%3").arg(name, QString::number(session, 16)).arg(phase);
}

}  // namespace

PhaseRing::PhaseRing(Journal &journal)
    : m_journal(journal)
{
}

PhaseRing::~PhaseRing()
{
    leave();
}

void PhaseRing::setPlant(const QString &plant, quint64 session)
{
    m_plant = plant;
    m_session = session;
}

/// The ring of the last phase: somebody who records still needs it, and deletes it then.
void PhaseRing::leave()
{
    close();
    if (m_ring && !m_ring->isRead() && !m_isKept)
        m_ring->memory().remove();
    m_ring.reset();
    m_isKept = false;
}

std::shared_ptr<RecordRing> PhaseRing::make(RingDescription description, std::size_t recordSize)
{
    leave();
    // Simulated masters are many, and nobody records them.
    if (m_plant.isEmpty() || &Host::current() != &Host::machine())
        return nullptr;
    removeDead();
    description.plant = m_plant;
    description.version = QStringLiteral(QTPLC_VERSION);
    description.session = m_session;
    description.phase = ++m_phase;
    for (auto parameter = m_parameters.begin(); parameter != m_parameters.end(); ++parameter)
        description.parameters.insert(parameter.key(), parameter.value());
    const QByteArray folder = RingMemory::folder();
    const double rate = 1e9 / double(description.period) * (description.scale > 0.0 ? description.scale : 1.0);
    const std::size_t capacity = RecordRing::capacityFor(rate, SecondsToKeep, recordSize, folder);
    auto ring = std::make_shared<RecordRing>();
    QString error;
    if (!ring->create(folder + '/' + QFile::encodeName(fileName(m_plant, m_session, m_phase)), capacity,
                      description.toText(), &error, TextCapacity)) {
        m_journal.tell(JournalEvent::Warning, JournalEvent::State, NodeRegistry::masterName(),
                       QStringLiteral("the cycles of this phase cannot be recorded: ") + error);
        return nullptr;
    }
    m_ring = ring;
    m_isOpen = true;
    if (m_begins)
        m_begins();
    if (m_isReady)
        m_isReady(file());
    return ring;
}

void PhaseRing::tell(RecordedText head, const QByteArray &text)
{
    head.wallTime = head.wallTime != 0 ? head.wallTime : wallClockNow();
    m_ring->addText(head, text);
}

void PhaseRing::close()
{
    if (std::exchange(m_isOpen, false))
        m_ring->endTexts();
}

QString PhaseRing::file() const
{
    return m_ring ? QFile::decodeName(m_ring->memory().file()) : QString();
}

void PhaseRing::removeDead()
{
    const QDir folder(QFile::decodeName(RingMemory::folder()));
    const QStringList names = folder.entryList({prefix() + QLatin1Char('*')}, QDir::Files, QDir::Time);
    int kept = 0;
    for (const QString &name : names) {
        const QString file = folder.filePath(name);
        const RingMemory::Use use = RingMemory::useOf(QFile::encodeName(file));
        if ((use == RingMemory::Dead || use == RingMemory::DeadAndRecorded) && ++kept > MostDeadOnes)
            QFile::remove(file);
    }
}

}  // namespace qplc
