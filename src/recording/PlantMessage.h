// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/cycle/RingReader.h"
#include "signals/ProcessImage.h"

#include <optional>

namespace qplc {

/// Converts a record of a cycle to the message of the channel /plant, and back: a ROS 1 message
/// with the cycle, each signal, and the qualities.
///
/// Numbers and arrays lie in the message as they do in the process image, one behind the other. A
/// text is the one type that is converted: its length, and the text without what follows it.
class PlantMessage
{
public:
    /// Fields of the message before the signals.
    struct Cycle
    {
        std::uint64_t number = 0;
        std::int64_t lateness = 0;  // [ns]
        std::uint64_t skipped = 0;
        std::uint32_t flags = 0;  // of RecordedCycle::Flag
    };
    static constexpr std::size_t CycleSize = 28;  // [byte]

    explicit PlantMessage(const QPlcSignalTable &table);

    /// The description of the message, as a file of ROS says it, with units and descriptions.
    QByteArray schema() const;
    static QByteArray schemaName() { return QByteArrayLiteral("qtplc/Plant"); }
    const QPlcSignalTable &table() const { return m_image.table(); }
    /// [byte] of a process image: values, padding, qualities
    std::uint32_t imageSize() const { return m_image.totalSize(); }

    /// The message of a cycle with \a image.
    void encode(const Cycle &cycle, const char *image, QByteArray *message) const;
    /// The image in a message; image() has it then. \return nothing when it is not such a message
    std::optional<Cycle> decode(const char *message, std::size_t size);
    ProcessImage &image() { return m_image; }
    const ProcessImage &image() const { return m_image; }

    /// Whether there are texts, so that places in the message vary.
    bool hasTexts() const { return m_hasTexts; }
    /// [byte] of each message, where there are no texts.
    std::size_t fixedSize() const { return CycleSize + m_image.size() + std::size_t(table().size()); }
    /// Where each signal begins in a message. \return false when it is not such a message
    bool locate(const char *message, std::size_t size, std::vector<std::uint32_t> *offsets) const;
    /// \param message  at least CycleSize bytes
    static Cycle cycleOf(const char *message);

private:
    ProcessImage m_image;
    bool m_hasTexts = false;
};

/// What a ROS message may call a field: \a name without other characters, unique among \a used.
QByteArray rosFieldName(const QString &name, QSet<QByteArray> *used);

}  // namespace qplc
