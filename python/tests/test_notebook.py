from collections.abc import Iterator
from typing import Any

import pytest
from jupyter_client.blocking.client import BlockingKernelClient
from jupyter_client.manager import KernelManager, start_new_kernel

import curveflow as cf

# Far more than anything takes: only a kernel that hangs needs so long.
PATIENCE = 60


@pytest.fixture
def kernel() -> Iterator[tuple[KernelManager, BlockingKernelClient]]:
    manager, client = start_new_kernel(kernel_name="python3")
    yield manager, client
    client.stop_channels()
    manager.shutdown_kernel(now=True)


def output(client: BlockingKernelClient, message: str) -> str:
    """All that a cell printed, once the kernel is idle."""
    text = ""
    while True:
        seen = client.get_iopub_msg(timeout=PATIENCE)
        content: dict[str, Any] = seen["content"]
        if seen["parent_header"].get("msg_id") != message:
            continue
        if seen["msg_type"] == "stream":
            text += content["text"]
        if seen["msg_type"] == "error":
            text += "\n".join(content["traceback"])
        if seen["msg_type"] == "status" and content["execution_state"] == "idle":
            return text


def started(client: BlockingKernelClient) -> None:
    while True:
        seen = client.get_iopub_msg(timeout=PATIENCE)
        if seen["msg_type"] == "stream" and "started" in seen["content"]["text"]:
            return


def test_an_interrupted_cell_leaves_its_partial_result(
    endless: cf.Scene, kernel: tuple[KernelManager, BlockingKernelClient]
):
    manager, client = kernel
    client.execute(
        f"""
import curveflow as cf
scene = cf.Scene.parse({endless.text!r})
def tell(progress):
    if progress.steps == 1:
        print("started", flush=True)
result = cf.run(scene, callback=tell)
"""
    )
    started(client)
    manager.interrupt_kernel()
    # The kernel answers again: the cell has ended, and what it computed is there.
    message = client.execute("print(result.status, len(result.time) >= 2, result.energy[-1] < result.energy[0])")
    assert output(client, message).strip() == "interrupted True True"
    # It goes on in the same kernel.
    message = client.execute("print(cf.run(cf.Scene.shipped('circle')).success)")
    assert output(client, message).strip() == "True"
