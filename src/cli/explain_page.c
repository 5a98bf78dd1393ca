/* An explanation as a page. In: what was recorded, the picture of the whole frame. Out: one HTML file that needs no other:
 * the picture, to zoom into, with the triangle of the step over it, and every step to click. Invariant: what is embedded
 * cannot end the element that it stands in. */
#include "explain_output.h"
#include "page.h"

#include "image/data_uri.h"

static const char *const head_lines[] = {
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">",
    "<title>lom explain</title><style>",
    "body{font:15px/1.4 sans-serif;margin:0;color:#222;background:#f6f6f4}h1{font-size:18px;margin:12px}",
    "main{display:flex;flex-wrap:wrap}section{padding:0 12px;box-sizing:border-box}#left{flex:1 1 480px;min-width:0}",
    "#right{flex:1 1 420px;min-width:0}canvas{width:100%;background:#888;touch-action:none;cursor:grab}",
    "ol{padding:0;margin:0;list-style:none;max-height:38vh;overflow:auto;background:#fff;border:1px solid #ccc}",
    "li{padding:3px 8px;cursor:pointer;border-bottom:1px solid #eee}li.on{background:#fd8}li.bad{color:#888}",
    "li.part{cursor:default;font-weight:bold;background:#eee;color:#222}table{border-collapse:collapse;font-size:13px}",
    "td{padding:1px 8px 1px "
    "0;vertical-align:top;font-family:monospace;word-break:break-word}td:first-child{color:#666}",
    "button{font-size:16px;margin:6px 6px 6px 0}#numbers{overflow:auto;max-height:52vh;background:#fff}",
    "h2{font-size:14px;margin:8px 0 2px}</style>",
    "<h1 id=\"verdict\"></h1><main><section id=\"left\"><canvas id=\"view\" width=\"960\" height=\"640\"></canvas>",
    "<div><button id=\"in\">zoom in</button><button id=\"out\">zoom out</button><button id=\"all\">whole "
    "picture</button>",
    "<button id=\"here\">the pixel</button></div></section><section id=\"right\"><button id=\"back\">&#9664; "
    "step</button>",
    "<button id=\"next\">step &#9654;</button><ol id=\"steps\"></ol><div id=\"numbers\"></div></section></main>",
};

static const char *const script_lines[] = {
    "const data=JSON.parse(document.getElementById('data').textContent),id=name=>document.getElementById(name);",
    "const view=id('view'),pen=view.getContext('2d'),picture=new Image(),parts=[data].concat(data.followed),steps=[];",
    "let scale=1,left=0,top_=0,at=0;",
    "id('verdict').textContent='Pixel '+data.x+','+data.y+' is '+data.pixel.join(' ')+': '+data.verdict;",
    "for(const part of parts){const name=part===data?'the picture':part.texture+', texel '+part.x+','+part.y;",
    "steps.push({part,title:name+': '+part.verdict});",
    "for(const draw of part.draws)for(const t of draw.triangles)steps.push({part,draw,t})}",
    "const list=id('steps');",
    "steps.forEach((step,i)=>{const li=document.createElement('li');step.li=li;",
    "if(step.title){li.textContent=step.title;li.className='part'}else{",
    "li.textContent=step.draw.pass_name+' \\u203a '+step.draw.name+' \\u203a '+step.draw.primitive+' "
    "'+step.t.number+': "
    "'+step.t.fate;",
    "if(!step.t.fate.startsWith('stored'))li.className='bad';li.onclick=()=>show(i)}list.append(li)});",
    "const text=v=>Array.isArray(v)?v.map(text).join('  '):v===null?'-':typeof v=='number'&&!Number.isInteger(v)?",
    "+v.toPrecision(7)+'':typeof v=='object'?Object.entries(v).map(([k,x])=>k+' '+text(x)).join(', '):v+'';",
    "function table(title,rows,box){const h=document.createElement('h2'),t=document.createElement('table');",
    "h.textContent=title;box.append(h,t);for(const[k,v]of rows){const r=t.insertRow();r.insertCell().textContent=k;",
    "r.insertCell().textContent=text(v)}}",
    "const rows=o=>Object.entries(o).filter(([k,v])=>!['vertices','clipped','notes','number','fate'].includes(k)&&",
    "!(Array.isArray(v)&&!v.length));",
    "function note(n){const{kind,...rest}=n;if(kind=='value')return[n.name,n.value];",
    "if(kind=='lookup'||kind=='texel'){const to=n.followed?' (followed below: "
    "'+data.followed[n.followed-1].verdict+')':'';",
    "return['looks up '+n.texture,text(n.result)+' at '+text(n.at||[])+', level '+text(n.level??0)+to+'; "
    "'+n.taps.map(t=>",
    "'texel '+t.x+','+t.y+' of level '+t.level+' * '+text(t.weight)+' = '+text(t.color)).join('; ')]}",
    "return[kind,rest]}",
    "function show(i){at=Math.max(0,Math.min(steps.length-1,i));const step=steps[at],box=id('numbers');",
    "if(step.title){if(at+1<steps.length&&!steps[at+1].title)return show(at+1)}",
    "steps.forEach(s=>s.li.classList.toggle('on',s===step));step.li.scrollIntoView({block:'nearest'});box.textContent='"
    "';",
    "if(step.t){table(step.draw.primitive+' '+step.t.number+': '+step.t.fate,rows(step.t),box);",
    "if(step.t.notes)table('its shader',step.t.notes.map(note),box);",
    "step.t.vertices.forEach((v,k)=>table('vertex '+k,rows(v).concat(v.notes.map(note)),box));",
    "(step.t.clipped||[]).forEach((v,k)=>table('clipped to, vertex '+k,rows(v),box));",
    "const{triangles,...rest}=step.draw;table('draw',rows(rest),box)}paint()}",
    "function paint(){pen.setTransform(1,0,0,1,0,0);pen.clearRect(0,0,view.width,view.height);",
    "pen.setTransform(scale,0,0,scale,-left*scale,-top_*scale);pen.imageSmoothingEnabled=false;const step=steps[at];",
    "const own=!step||step.part===data;if(own)pen.drawImage(picture,0,0);const w=1/scale;",
    "if(step&&step.t)for(const[vertices,color]of[[step.t.vertices,'#f40'],[step.t.clipped||[],'#06f']]){",
    "if(!vertices.length)continue;pen.beginPath();for(const v of vertices)pen.lineTo(...v.window.slice(0,2).map(x=>",
    "x===null?0:Math.max(-1e5,Math.min(1e5,x))));pen.closePath();pen.lineWidth=2*w;pen.strokeStyle=color;pen.stroke();",
    "pen.globalAlpha=.15;pen.fillStyle=color;pen.fill();pen.globalAlpha=1}",
    "const p=own?data:step.part;pen.lineWidth=w*1.5;pen.strokeStyle='#fff';pen.strokeRect(p.x,p.y,1,1);",
    "pen.strokeStyle='#000';pen.strokeRect(p.x-w*1.5,p.y-w*1.5,1+3*w,1+3*w)}",
    "function zoom(f,x,y){const px=left+x/scale,py=top_+y/scale;scale=Math.max(.05,Math.min(200,scale*f));",
    "left=px-x/scale;top_=py-y/scale;paint()}",
    "function whole(){scale=Math.min(view.width/data.width,view.height/data.height);left=top_=0;paint()}",
    "function here(){const "
    "p=steps[at]?steps[at].part:data;scale=24;left=p.x+.5-view.width/48;top_=p.y+.5-view.height/48;",
    "paint()}",
    "const point=e=>{const r=view.getBoundingClientRect();return[(e.clientX-r.left)*view.width/r.width,",
    "(e.clientY-r.top)*view.height/r.height]};",
    "view.onwheel=e=>{e.preventDefault();zoom(e.deltaY<0?1.25:.8,...point(e))};",
    "view.onpointermove=e=>{if(!e.buttons)return;const r=view.getBoundingClientRect(),k=view.width/r.width/scale;",
    "left-=e.movementX*k;top_-=e.movementY*k;paint()};",
    "id('in').onclick=()=>zoom(1.5,view.width/2,view.height/2);id('out').onclick=()=>zoom(1/1.5,view.width/"
    "2,view.height/2);",
    "id('all').onclick=whole;id('here').onclick=here;id('next').onclick=()=>show(at+1);",
    "id('back').onclick=()=>{let i=at-1;while(i>0&&steps[i].title)i--;show(i)};",
    "document.onkeydown=e=>{if(e.key=='ArrowRight')id('next').onclick();if(e.key=='ArrowLeft')id('back').onclick()};",
    "picture.onload=()=>{whole();const last=steps.map((s,i)=>s.part===data&&s.t&&s.t.fate=='stored'?i:0);",
    "show(Math.max(...last)||1);document.title='lom explain: '+steps.length+' steps'};",
    "picture.src=id('picture').textContent;",
};

static void print_page(FILE *out, lom_bytes explanation, lom_bytes png)
{
    lom_print_lines(out, head_lines, sizeof head_lines / sizeof head_lines[0]);
    fputs("<script type=\"text/plain\" id=\"picture\">", out);
    lom_print_data_uri(out, png);
    fputs("</script>\n<script type=\"application/json\" id=\"data\">", out);
    lom_print_embedded(out, explanation);
    fputs("</script>\n<script>\n", out);
    lom_print_lines(out, script_lines, sizeof script_lines / sizeof script_lines[0]);
    fputs("</script></html>\n", out);
}

static lom_bytes print_explanation(const struct lom_explain_head *head, lom_error *error)
{
    struct lom_page json;
    lom_begin_page(&json);
    if (json.out != NULL)
        lom_write_explanation(json.out, head);
    return lom_end_page(&json, error);
}

lom_bytes lom_explanation_page(const struct lom_explain_head *head, const lom_image *picture, lom_error *error)
{
    lom_bytes page = { NULL, 0 }, png = lom_encode_shown_image(picture, error);
    lom_bytes explanation = png.data != NULL ? print_explanation(head, error) : page;
    if (explanation.data != NULL) {
        struct lom_page html;
        lom_begin_page(&html);
        if (html.out != NULL)
            print_page(html.out, explanation, png);
        page = lom_end_page(&html, error);
    }
    lom_release(explanation.data);
    lom_release(png.data);
    return page;
}
