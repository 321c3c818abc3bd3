// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "node/cycle/RecordRing.h"
#include "node/cycle/RingReader.h"

#include <QtCore/QFile>

#include <cstring>
#include <memory>
#include <unistd.h>

/// A ring with a file of its own, which is gone in the end.
struct TestRing
{
    explicit TestRing(std::size_t capacity = 64 * 1024, std::size_t textCapacity = 0)
        : ring(std::make_shared<qplc::RecordRing>())
    {
        static int count = 0;
        file = qplc::RingMemory::folder() + "/qtplc-test-" + QByteArray::number(::getpid()) + '-'
            + QByteArray::number(++count);
        isThere = ring->create(file, capacity, "a description", &error, textCapacity);
    }
    ~TestRing() { QFile::remove(QFile::decodeName(file)); }
    TestRing(const TestRing &) = delete;
    TestRing &operator=(const TestRing &) = delete;

    /// A record with \a number and bytes that follow from it. \return false when it has no room
    bool write(std::uint64_t number)
    {
        const std::uint32_t size = sizeOf(number);
        char *to = ring->begin(size);
        if (!to)
            return false;
        std::memcpy(to, &number, sizeof number);
        std::memset(to + 8, int(number & 0xff), size - 24);
        ring->commit(qplc::RecordKind::Cycle, size);
        return true;
    }
    static std::uint32_t sizeOf(std::uint64_t number) { return 24 + 8 * std::uint32_t(number * 7 % 50); }
    /// The number of a record that write() has made; -1: it is none, or not whole.
    static qint64 numberOf(const qplc::RingReader &reader)
    {
        std::uint64_t number = 0;
        std::memcpy(&number, reader.body(), sizeof number);
        if (reader.size() != sizeOf(number) - 16)
            return -1;
        for (std::uint32_t i = 8; i < reader.size(); ++i) {
            if (reader.body()[i] != char(number & 0xff))
                return -1;
        }
        return qint64(number);
    }

    QByteArray file;
    QString error;
    std::shared_ptr<qplc::RecordRing> ring;
    bool isThere = false;
};
