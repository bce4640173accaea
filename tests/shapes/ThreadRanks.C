// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/ThreadRanks.H"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace Foam::stability::shapes
{

namespace
{

// The memory through which the ranks exchange packets.
class Board
{
public:
    explicit Board(label nRanks) : packets_(nRanks) {}

    label nRanks() const { return label(packets_.size()); }

    std::vector<Packet> exchange(label rank, std::vector<Packet> toRanks)
    {
        packets_[rank] = std::move(toRanks);
        meet();
        std::vector<Packet> received;
        for (const std::vector<Packet>& fromRank : packets_)
        {
            received.push_back(fromRank.at(rank));
        }
        meet(); // before the next packets
        return received;
    }

    void leave()
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        someLeft_ = true;
        changed_.notify_all();
    }

private:
    void meet()
    {
        std::unique_lock<std::mutex> lock(mutex_);
        const label meeting = nMeetings_;
        if (++nWaiting_ == nRanks())
        {
            nWaiting_ = 0;
            ++nMeetings_;
            changed_.notify_all();
        }
        changed_.wait(lock, [&] { return nMeetings_ > meeting || someLeft_; });
        if (nMeetings_ == meeting)
        {
            throw std::logic_error("A rank waits for one that has ended.");
        }
    }

    std::vector<std::vector<Packet>> packets_; // per sender and receiver
    std::mutex mutex_;
    std::condition_variable changed_;
    label nWaiting_ = 0;
    label nMeetings_ = 0;
    bool someLeft_ = false;
};

class ThreadExchange : public Exchange
{
public:
    ThreadExchange(Board& board, label rank) : board_(board), rank_(rank) {}

    label nRanks() const override { return board_.nRanks(); }
    label rank() const override { return rank_; }

    std::string firstNonEmpty(const std::string& text) const override
    {
        Packet packet;
        for (const char c : text)
        {
            packet.put(c);
        }
        for (const Packet& other : send(std::vector<Packet>(nRanks(), packet)))
        {
            if (!other.empty())
            {
                return std::string(other.bytes().begin(), other.bytes().end());
            }
        }
        return std::string();
    }

private:
    std::vector<Packet> send(std::vector<Packet> toRanks) const override
    {
        return board_.exchange(rank_, std::move(toRanks));
    }

    label sumOf(label value) const override
    {
        Packet packet;
        packet.put(value);
        label sum = 0;
        for (Packet& other : send(std::vector<Packet>(nRanks(), packet)))
        {
            sum += other.get<label>();
        }
        return sum;
    }

    Board& board_;
    label rank_;
};

} // namespace

void onRanks(label nRanks, const std::function<void(const Exchange&)>& work)
{
    Board board(nRanks);
    std::vector<std::exception_ptr> failures(nRanks);
    std::vector<std::thread> threads;
    for (label ranki = 0; ranki < nRanks; ++ranki)
    {
        threads.emplace_back(
            [&, ranki]
            {
                try
                {
                    work(ThreadExchange(board, ranki));
                }
                catch (...)
                {
                    failures[ranki] = std::current_exception();
                }
                board.leave();
            }
        );
    }
    for (std::thread& thread : threads)
    {
        thread.join();
    }
    for (const std::exception_ptr& failure : failures)
    {
        if (failure)
        {
            std::rethrow_exception(failure);
        }
    }
}

} // namespace Foam::stability::shapes
