"""The emitted RTL in a pyuvm environment, whose scoreboard asks `blysk.Model`."""

import os

import blysk
import cocotb
import pyuvm
from blysk.cocotb import Highlight, Request
from pyuvm import (
    ConfigDB,
    uvm_agent,
    uvm_analysis_port,
    uvm_driver,
    uvm_env,
    uvm_monitor,
    uvm_sequence,
    uvm_sequence_item,
    uvm_sequencer,
    uvm_subscriber,
    uvm_test,
)


class HighlightItem(uvm_sequence_item):
    """A request on its way to the design."""

    def __init__(self, name, request):
        super().__init__(name)
        self.request = request


class StimulusSequence(uvm_sequence):
    """The vectors that Blysk chooses, corners among them."""

    async def body(self):
        bench = ConfigDB().get(None, "", "BENCH")
        for request in bench.stimulus(300):
            item = HighlightItem("request", request)
            await self.start_item(item)
            await self.finish_item(item)


class Driver(uvm_driver):
    """Hands requests to the bench's driver, which adds gaps and keeps the handshake."""

    async def run_phase(self):
        bench = ConfigDB().get(None, "", "BENCH")
        await bench.reset()
        while True:
            item = await self.seq_item_port.get_next_item()
            bench.driver.waiting.append(item.request)
            self.seq_item_port.item_done()


class Monitor(uvm_monitor):
    """Tells every sample of the ports."""

    def build_phase(self):
        self.ap = uvm_analysis_port("ap", self)
        ConfigDB().get(None, "", "BENCH").monitor.listeners.append(self.ap.write)


class Scoreboard(uvm_subscriber):
    """Asks the golden model for the answer to each request."""

    def build_phase(self):
        self.model = ConfigDB().get(None, "", "BENCH").model
        self.formats = self.model.formats
        self.requests, self.results = [], 0

    def write(self, sample):
        if sample.rst != 0:
            self.requests.clear()
            return
        if sample.delivered:
            request = self.requests.pop(0)
            x = self.formats["x"].bits(request.x)
            intensity, status = self.model.evaluate(request.address, x)
            assert (sample.intensity, sample.status) == (intensity, status), f"{request}: {sample}"
            self.results += 1
        if sample.taken:
            self.requests.append(Request(sample.address, sample.x))

    def check_phase(self):
        assert self.results == 300, f"{self.results} results of 300"
        self.logger.info(f"{self.results} results compared")


class Agent(uvm_agent):
    """Sequencer, driver and monitor of the pipeline's ports."""

    def build_phase(self):
        self.seqr = uvm_sequencer("seqr", self)
        self.driver = Driver("driver", self)
        self.monitor = Monitor("monitor", self)

    def connect_phase(self):
        self.driver.seq_item_port.connect(self.seqr.seq_item_export)


class Environment(uvm_env):
    """The agent and the scoreboard that listens to it."""

    def build_phase(self):
        self.agent = Agent("agent", self)
        self.scoreboard = Scoreboard("scoreboard", self)

    def connect_phase(self):
        self.agent.monitor.ap.connect(self.scoreboard.analysis_export)


@pyuvm.test()
class AnswersAsTheModel(uvm_test):
    """Every answer of the design is the model's."""

    def build_phase(self):
        bench = Highlight(cocotb.top, blysk.Model.from_file(os.environ["BLYSK_CONFIGURATION"]), registers=False)
        ConfigDB().set(None, "*", "BENCH", bench)
        self.bench = bench
        self.env = Environment("env", self)

    async def run_phase(self):
        self.raise_objection()
        await StimulusSequence("stimulus").start(self.env.agent.seqr)
        await self.bench.drain()
        self.drop_objection()
